"""A document as one line of JSON; imports neither NumPy nor rich, so that an error is quick."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

# What json.dumps leaves in place and a reader could take for the end of a line, or cannot
# encode as UTF-8: file names that were no text arrive as lone surrogates.
_UNSAFE = re.compile("[\x7f-\x9f\u2028\u2029\ud800-\udfff]")


def json_line(document: Mapping[str, Any]) -> str:
    r"""One document as one line of UTF-8 text, without the line's end.

    Raises
    ------
    ValueError
        A number is not finite. The documents of this package hold only finite numbers.

    Examples
    --------
    >>> json_line({"b": 1.5, "a": "Müller\n\u2028"})
    '{"a":"Müller\\n\\u2028","b":1.5}'
    """
    text = json.dumps(
        document, sort_keys=True, ensure_ascii=False, allow_nan=False, separators=(",", ":")
    )
    return _UNSAFE.sub(lambda match: f"\\u{ord(match[0]):04x}", text)
