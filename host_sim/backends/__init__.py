"""Where robots run: in a process, in this process, on a bus, or as an image on an emulated board."""
