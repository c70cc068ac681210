// A target has a source; this one is for the header beside it.
