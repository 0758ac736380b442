"""Checks of the code beyond its tests: mutation testing, coverage, MISRA C and image sizes."""
