"""What every room stands on: errors, paths, files, C interfaces."""
