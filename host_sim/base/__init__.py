"""What every other package uses: errors, paths, files, C interfaces."""
