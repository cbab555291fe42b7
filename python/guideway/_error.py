"""Exceptions that Python code of the package raises."""

from __future__ import annotations

from . import GuidewayError


def refusal(message: str, remedy: str, code: str = "argument") -> GuidewayError:
    """An exception with code, message and remedy, as those of the extension module."""
    error = GuidewayError(f"{message}. {remedy}")
    error.code, error.message, error.remedy = code, message, remedy
    return error
