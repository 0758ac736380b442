"""The keys that images are signed with, Ed25519."""

import hashlib
import os
from pathlib import Path

from host_sim.base.errors import OctetError, UsageError

try:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
    from cryptography.hazmat.primitives.serialization import (
        Encoding,
        NoEncryption,
        PrivateFormat,
        PublicFormat,
        load_pem_private_key,
    )
except ImportError as error:
    raise OctetError("cryptography is not installed: run tools/setup images") from error

__all__ = ["Ed25519PrivateKey", "development_key", "is_development", "load_key", "make_key", "public_bytes"]


def development_key() -> Ed25519PrivateKey:
    """The private key for images that need no protection: everybody has it."""
    return Ed25519PrivateKey.from_private_bytes(hashlib.sha256(b"octet development key: everybody has it").digest())


def public_bytes(key: Ed25519PrivateKey) -> bytes:
    """The public key, 32 bytes."""
    return key.public_key().public_bytes(Encoding.Raw, PublicFormat.Raw)


def is_development(shown: bytes) -> bool:
    """Whether a public key, or its first bytes, belongs to the development key."""
    return public_bytes(development_key()).startswith(shown)


def make_key(path: Path) -> Ed25519PrivateKey:
    """Makes a key and writes it to a new file that only this user can read.

    Raises:
        UsageError: The file is there already, or cannot be written.
    """
    key = Ed25519PrivateKey.generate()
    try:
        with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
            file.write(key.private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption()))
    except OSError as error:
        raise UsageError(f"cannot write the key {path}: {error.strerror}; choose another file") from error
    return key


def load_key(path: Path) -> Ed25519PrivateKey:
    """Reads a key.

    Raises:
        UsageError: The file cannot be read, or is no Ed25519 key.
    """
    try:
        key = load_pem_private_key(path.read_bytes(), None)
    except OSError as error:
        raise UsageError(f"cannot read the key {path}: {error.strerror}") from error
    except (TypeError, ValueError) as error:
        raise UsageError(f"{path} is not a private key in PEM format without a password") from error
    if not isinstance(key, Ed25519PrivateKey):
        raise UsageError(f"{path} is not an Ed25519 key; tools/octet keygen makes one")
    return key
