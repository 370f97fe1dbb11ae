"""The page's style, and the policy that lets a browser apply it, run one script, and no more."""

from __future__ import annotations

import base64
import hashlib

STYLE = """
:root { --ink: #1d2a35; --quiet: #5a6875; --line: #d5dce2; --wash: #f4f6f8; --mark: #0b5a8f;
  --good: #1b7a4b; --acceptable: #a86200; --poor: #b3261e; --reject: #5f1512; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 28px 32px 40px; max-width: 1080px; color: var(--ink);
  background: #fff; font: 15px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", sans-serif; }
h1 { font-size: 27px; margin: 0 0 2px; letter-spacing: -0.015em; }
h2 { font-size: 18px; margin: 30px 0 10px; padding-bottom: 4px;
  border-bottom: 1px solid var(--line); }
h3 { margin: 0 0 6px; font-size: 16px; overflow-wrap: anywhere; }
p { margin: 6px 0; max-width: 80ch; }
.lead { color: var(--quiet); max-width: none; overflow-wrap: anywhere; }
.best { margin: 18px 0 8px; padding: 14px 20px; background: var(--wash);
  border-left: 6px solid var(--mark); border-radius: 4px; }
.best.good { border-color: var(--good); }
.best.acceptable { border-color: var(--acceptable); }
.best.poor { border-color: var(--poor); }
.best b { font-size: 22px; overflow-wrap: anywhere; }
.best p { margin: 2px 0; }
.best .light { float: right; font-size: 17px; margin-left: 16px; }
i { font-style: normal; }
.light { font-weight: 650; white-space: nowrap; }
.good, i.good { color: var(--good); }
.acceptable, i.acceptable { color: var(--acceptable); }
.poor, i.poor { color: var(--poor); }
.reject, i.reject { color: var(--reject); }
.none, i.none { color: var(--quiet); font-weight: 400; }
.best, .best b, .best p { color: var(--ink); }
.feet { display: flex; gap: 18px; flex-wrap: wrap; }
.foot { flex: 1 1 320px; border: 1px solid var(--line); border-radius: 6px; padding: 12px 18px; }
.sizes { display: flex; flex-wrap: wrap; gap: 6px; margin: 2px 0 10px; padding: 0; }
.sizes li { list-style: none; padding: 2px 10px; border: 1px solid var(--line);
  border-radius: 12px; font-weight: 600; }
.sizes li.asked { background: var(--mark); border-color: var(--mark); color: #fff; }
.sizes small { font-weight: 400; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 1px 16px; margin: 0; }
.foot dl { grid-template-columns: max-content 1fr max-content 1fr; }
.pair .foot dl { grid-template-columns: max-content 1fr; }
.lacking { color: var(--quiet); font-size: 13px; max-width: none; }
dt { color: var(--quiet); }
dd { margin: 0; overflow-wrap: anywhere; font-variant-numeric: tabular-nums; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: 7px 12px 7px 0;
  border-bottom: 1px solid var(--line); overflow-wrap: anywhere; }
thead th { color: var(--quiet); font-weight: 600; font-size: 13px; }
tbody th { font-weight: 650; }
.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
td.why { min-width: 16em; }
td.verdict { white-space: nowrap; }
tbody th.name { min-width: 7em; }
th small { display: block; font-weight: 400; color: var(--quiet); }
table.zones td, table.zones th { padding-top: 3px; padding-bottom: 3px; }
table.rooms { margin-top: 10px; }
table.first tbody tr:first-child > * { background: var(--wash); }
.warn { max-width: none; border-left: 4px solid #b45309; padding: 4px 12px; margin: 8px 0;
  background: #fff8ee; overflow-wrap: anywhere; }
figure { margin: 12px 0 22px; }
figure img { width: 100%; height: auto; display: block; }
figcaption { color: var(--quiet); font-size: 13px; margin-top: 4px; overflow-wrap: anywhere; }
.scene { border: 1px solid var(--line); border-radius: 6px; padding: 10px 14px; }
.scene[hidden] { display: none; }
.scene canvas { display: block; width: 100%; height: 460px; cursor: grab; touch-action: pan-y; }
.scene canvas:focus-visible { outline: 2px solid var(--mark); }
.controls { display: flex; flex-wrap: wrap; gap: 6px 18px; align-items: center; margin: 6px 0; }
.controls button { font: inherit; font-size: 14px; padding: 3px 12px; margin-right: 5px;
  border: 1px solid var(--line); border-radius: 4px; background: #fff; color: var(--ink); }
.controls button:hover { background: var(--wash); }
.legend { width: 100%; max-width: 720px; display: block; margin: 8px auto 0; }
.legend text { font-size: 10.5px; text-anchor: middle; fill: var(--ink); }
.legend .start { text-anchor: start; }
.legend .end { text-anchor: end; }
.read { color: var(--quiet); font-size: 13px; }
.read p { max-width: none; margin: 3px 0; }
footer { margin-top: 26px; color: var(--quiet); font-size: 13px; }
.scroll { overflow-x: auto; }
@media screen and (max-width: 640px) {
  body { padding: 18px 14px 30px; }
  .best { padding: 12px 14px; }
  .best .light { float: none; margin: 0; display: block; }
  .foot { padding: 10px 12px; flex-basis: 100%; }
  .foot dl, .pair .foot dl { grid-template-columns: max-content 1fr; gap: 1px 12px;
    font-size: 14px; }
  .scene { padding: 8px 10px; }
  .scene canvas { height: 320px; }
  .legend { overflow: visible; }
  .legend text { font-size: 17px; }
  .legend text:nth-of-type(3n):not(.end), .legend text:nth-of-type(3n+2):not(.start) {
    display: none; }
  figure.wide, figure.flare { overflow-x: auto; }
  figure.wide img, figure.flare img { width: 680px; max-width: none; }
  th, td { padding-right: 10px; }
  table.first thead { display: none; }
  table.first tr { display: flex; flex-wrap: wrap; align-items: baseline; gap: 0 12px;
    padding: 8px 6px; border-bottom: 1px solid var(--line); }
  table.first tr > * { border: 0; padding: 0; }
  table.first th.name { flex: 1 1 60%; }
  table.first td.n[data-head]:not([data-head=""])::before { content: attr(data-head) " ";
    color: var(--quiet); font-size: 13px; }
  table.first td.why { flex: 1 1 100%; }
}
@page { size: A4; margin: 11mm 12mm; }
@media print {
  body { padding: 0; max-width: none; font-size: 8.6pt; line-height: 1.38; }
  h1 { font-size: 16pt; }
  h2 { font-size: 11pt; margin: 9px 0 4px; break-after: avoid; }
  h3 { font-size: 10pt; margin-bottom: 2px; break-after: avoid; }
  p { margin: 2px 0; max-width: none; }
  th, td { padding: 2.5px 8px 2.5px 0; }
  thead th { font-size: 8pt; }
  table.zones td, table.zones th { padding-top: 1px; padding-bottom: 1px; }
  table.zones { font-size: 8pt; line-height: 1.28; }
  table.rooms { font-size: 7.2pt; line-height: 1.3; margin-top: 3px; }
  table.rooms th.name { min-width: 0; white-space: nowrap; }
  .scroll { overflow: visible; }
  .best { margin: 7px 0 4px; padding: 7px 12px; }
  .best b { font-size: 13pt; }
  .best .light { font-size: 11pt; }
  .foot { padding: 6px 10px; flex: 1 1 45%; }
  .foot dl { grid-template-columns: repeat(3, max-content 1fr); gap: 0 10px; }
  .pair .foot { font-size: 7.6pt; line-height: 1.28; }
  .pair .foot dl { grid-template-columns: max-content 1fr; }
  .pair .sizes li { padding: 0 5px; }
  .lacking { font-size: 7.5pt; }
  .sizes { margin: 0 0 4px; gap: 4px; }
  .sizes li { padding: 0 7px; }
  .scene { display: none; }
  .controls { display: none; }
  figure { margin: 4px 0 6px; }
  figcaption { font-size: 7.2pt; margin-top: 1px; }
  figure.wide img { width: 85%; margin: 0 auto; }
  figure.flare img { width: 57%; margin: 0 auto; }
  .two { display: flex; gap: 10px; }
  .two > * { flex: 1 1 50%; min-width: 0; }
  .two figure img, .two figure.wide img { width: 100%; }
  .two figure.flare img { width: 94%; }
  .two table, .two p { font-size: 7.2pt; }
  .two th, .two td { padding-right: 4px; }
  .two thead th { font-size: 7pt; }
  .screen { display: none; }
  .read { font-size: 7pt; line-height: 1.22; columns: 2; column-gap: 14px; margin-top: 4px; }
  .read h2 { column-span: all; margin: 4px 0 3px; font-size: 9pt; }
  .read p { margin: 1px 0; }
  footer { display: none; }
  .two figcaption { display: none; }
  .two ~ div figure.wide img { width: 68%; }
  figure, .foot, .best, tr, .read, .together { break-inside: avoid; }
  .best, .warn, .first tr > *, .sizes li { print-color-adjust: exact;
    -webkit-print-color-adjust: exact; }
}
"""


def content_hash(content: str) -> str:
    """A style's or script's hash as a content-security policy names it."""
    digest = hashlib.sha256(content.encode("utf-8")).digest()
    return f"sha256-{base64.b64encode(digest).decode('ascii')}"


def policy(script: str | None = None) -> str:
    """The content-security policy: this style, this script if there is one, pictures inside the
    page, nothing from outside and nothing to outside.
    """
    runs = f"script-src '{content_hash(script)}'; " if script else ""
    return (
        f"default-src 'none'; {runs}style-src '{content_hash(STYLE)}'; img-src data:; "
        "base-uri 'none'; form-action 'none'"
    )
