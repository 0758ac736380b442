"""The robot of a log in a debugger."""
