"""Basics for all other packages: errors, paths, files, C interfaces."""
