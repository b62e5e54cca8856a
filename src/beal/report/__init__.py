"""One self-contained HTML page from text, tables and figures."""

from beal.report.html import Page, data_uri, table
from beal.report.run import Picture, Section, Table, run_page

__all__ = ["Page", "Picture", "Section", "Table", "data_uri", "run_page", "table"]
