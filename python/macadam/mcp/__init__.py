# SPDX-License-Identifier: GPL-3.0-or-later
"""A server for assistants that speak the Model Context Protocol (MCP): they make scenes, check and run them, and read
results, in one folder. `workspace.py` has the functions, `server.py` offers them as tools."""
