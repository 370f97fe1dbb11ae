"""1:1 sheets: the views of a shape in true size, laid out on paper, as PDF, SVG and DXF."""
