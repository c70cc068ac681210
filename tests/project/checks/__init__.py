"""Checks of the source tree. Each module has check(root) -> list of problems, empty when all is well."""
