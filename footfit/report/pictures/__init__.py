"""Results as SVG and PNG pictures; the only room that draws."""
