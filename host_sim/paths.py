"""Where things are in the project's folder."""

from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
"""The folder of the project."""

BUILD = ROOT / "build"
"""What is made when building."""

WEB = ROOT / "host_sim" / "web"
"""The page's own files."""
