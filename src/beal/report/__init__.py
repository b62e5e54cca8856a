"""One self-contained HTML page from text, tables and figures."""

from beal.report.html import Page, data_uri, table

__all__ = ["Page", "data_uri", "table"]
