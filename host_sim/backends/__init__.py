"""Where a robot comes from: a process, this process, a bus, or an image on a board that is not there."""
