"""What can go wrong for a user, each with one line that says what was wrong and what to do."""


class OctetError(Exception):
    """A fault while running: the command ends with exit code 1."""

    exit_code = 1


class UsageError(OctetError):
    """The command makes no sense as it was given: it ends with exit code 2, and nothing was changed."""

    exit_code = 2


class RobotError(OctetError):
    """The robot is gone, silent, or not the one we can talk to."""


class RefusedError(RobotError):
    """The robot understood a command and refused it; nothing was changed."""
