"""The page's style, and the policy that lets a browser apply this style and nothing else."""

from __future__ import annotations

import base64
import hashlib

STYLE = """
:root { --ink: #22303c; --quiet: #5d6b78; --line: #d5dce2; --wash: #f4f6f8; --mark: #0b5a8f; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 28px 32px 48px; max-width: 1040px; color: var(--ink);
  background: #fff; font: 15px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", sans-serif; }
h1 { font-size: 26px; margin: 0 0 2px; letter-spacing: -0.01em; }
h2 { font-size: 18px; margin: 34px 0 10px; padding-bottom: 4px;
  border-bottom: 1px solid var(--line); }
p { margin: 6px 0; max-width: 76ch; }
.lead { color: var(--quiet); }
.best { margin: 20px 0 8px; padding: 16px 20px; background: var(--wash);
  border-left: 5px solid var(--mark); border-radius: 3px; }
.best b { font-size: 21px; }
.best p { margin: 2px 0; }
.feet { display: flex; gap: 18px; flex-wrap: wrap; }
.foot { flex: 1 1 320px; border: 1px solid var(--line); border-radius: 5px; padding: 12px 18px; }
.foot h3 { margin: 0 0 6px; font-size: 16px; overflow-wrap: anywhere; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 3px 16px; margin: 0; }
dt { color: var(--quiet); }
dd { margin: 0; overflow-wrap: anywhere; font-variant-numeric: tabular-nums; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: 8px 14px 8px 0;
  border-bottom: 1px solid var(--line); }
th { color: var(--quiet); font-weight: 600; font-size: 13px; }
td { overflow-wrap: anywhere; }
td.label { min-width: 8.5em; }
.n { text-align: right; font-variant-numeric: tabular-nums; }
td.n { white-space: nowrap; }
td.why { min-width: 15em; }
.name { font-weight: 650; min-width: 8.5em; }
tr.first td { background: var(--wash); }
.warn { max-width: none; border-left: 4px solid #b45309; padding: 4px 12px; margin: 8px 0;
  background: #fff8ee; }
figure { margin: 14px 0 24px; }
figure img { width: 100%; height: auto; display: block; }
figcaption { color: var(--quiet); font-size: 13px; margin-top: 4px; }
footer { margin-top: 36px; color: var(--quiet); font-size: 13px; }
@page { size: A4; margin: 14mm; }
@media print {
  body { padding: 0; max-width: none; font-size: 9.5pt; }
  th { font-size: 8.5pt; }
  td.label, td.name { min-width: 7em; }
  h2, h3 { break-after: avoid; }
  figure { margin: 6px 0 10px; }
  figure img { width: 80%; margin: 0 auto; }
  h2 { margin-top: 20px; }
  figure, .foot, .best, tr { break-inside: avoid; }
  .best, .warn, tr.first td { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
"""


def style_hash() -> str:
    """The style's hash as a content-security policy names it."""
    digest = hashlib.sha256(STYLE.encode("utf-8")).digest()
    return f"sha256-{base64.b64encode(digest).decode('ascii')}"


def policy() -> str:
    """The content-security policy: this style, pictures inside the page, nothing from outside."""
    return (
        f"default-src 'none'; style-src '{style_hash()}'; img-src data:; "
        "base-uri 'none'; form-action 'none'"
    )
