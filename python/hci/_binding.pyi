"""The module that is built: types are those of C."""
from typing import Any

ffi: Any
lib: Any
