"""Checks a robot against docs/protocol.md, sentence by sentence."""
