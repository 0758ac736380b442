"""The errors that a user can see. Each message is one line that says what was wrong and what to do."""


class OctetError(Exception):
    """A fault while running: the command ends with exit code 1."""

    exit_code = 1


class UsageError(OctetError):
    """The command line is invalid: the command ends with exit code 2, and nothing was changed."""

    exit_code = 2


class RobotError(OctetError):
    """The robot has ended, does not answer, or uses another protocol."""


class RefusedError(RobotError):
    """The robot understood a command and refused it; nothing was changed."""
