# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports: one self-contained HTML file from any result folders of macadam."""

from macadam.report.document import report
from macadam.report.folders import ReportError

__all__ = ["ReportError", "report"]
