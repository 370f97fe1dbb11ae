"""A document as one line of JSON; opens neither NumPy nor rich, so that an error is quick."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING

from footfit import __version__

if TYPE_CHECKING:
    from footfit.errors import FootfitError

Json = dict[str, object]

# What json.dumps leaves in place and a reader could take for the end of a line, or cannot
# encode as UTF-8: file names that were no text arrive as lone surrogates.
_UNSAFE = re.compile("[\x7f-\x9f\u2028\u2029\ud800-\udfff]")


def document(command: str, keys: Json, *, version: int = 1) -> Json:
    """``keys`` under the command's schema, in the schema's ``version``, and this footfit's."""
    return {"schema": f"footfit.{command}/{version}", "footfit_version": __version__, **keys}


def json_line(document: Json) -> str:
    r"""One document as one line of UTF-8 text, without the line's end.

    Raises
    ------
    ValueError
        A number is not finite: the documents of this package never hold one.

    Examples
    --------
    >>> json_line({"b": 1.5, "a": "Müller\n\u2028"})
    '{"a":"Müller\\n\\u2028","b":1.5}'
    """
    text = json.dumps(
        document, sort_keys=True, ensure_ascii=False, allow_nan=False, separators=(",", ":")
    )
    return _UNSAFE.sub(lambda match: f"\\u{ord(match[0]):04x}", text)


def error_document(error: FootfitError) -> Json:
    """``footfit.error/1``: the last line of stderr, and a failed mesh's line on stdout."""
    return failure_document(error.code, int(error.exit), error.message, error.path)


def failure_document(code: str, exit_code: int, message: str, path: str | None) -> Json:
    """``footfit.error/1`` of what is known by its words alone, such as a refused file."""
    keys: Json = {"code": code, "exit": exit_code, "message": message, "path": path}
    return document("error", keys)
