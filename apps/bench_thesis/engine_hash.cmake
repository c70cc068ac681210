# Writes the hash of the library into a header, so that results of another engine are not taken for those of this one.
file(SHA256 "${LIBRARY}" hash)
string(SUBSTRING "${hash}" 0 16 hash)
set(text "\"${hash}\"\n")
file(WRITE "${OUT}" "${text}")
