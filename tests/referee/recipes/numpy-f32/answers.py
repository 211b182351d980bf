"""A textbook in float32."""
from textbook import answer  # noqa: F401
