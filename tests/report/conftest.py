"""Runs to look at, and one to change."""

from tests.recording.conftest import kept, short, ten_seconds

__all__ = ["kept", "short", "ten_seconds"]
