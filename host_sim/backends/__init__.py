"""Backends that run robots: in a process, in this process, on a bus, or as an image on an emulated board."""
