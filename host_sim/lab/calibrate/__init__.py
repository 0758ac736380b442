"""Calibration of robots with bodies on pins."""
