# SPDX-License-Identifier: GPL-3.0-or-later
"""Offers the functions of a workspace as tools of an MCP server. Needs the Python package mcp."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

from mcp.server.mcpserver import MCPServer
from mcp.server.mcpserver.exceptions import ToolError

from macadam.mcp.paths import RequestError
from macadam.mcp.workspace import Workspace

#: Names of the tools; each is a method of Workspace.
TOOLS = ("info", "new_scene", "check", "run", "results", "report")
_INSTRUCTIONS = (
    "Macadam computes the mechanics of asphalt mixtures by discrete elements. Make a scene with new_scene, check it, run "
    "it, and read its results. All numbers are in SI units, angles in degrees. Errors name the key, the value found and "
    "the value expected."
)


def make_server(workspace: Workspace) -> MCPServer:
    """Returns a server with the tools of the workspace."""
    server = MCPServer("macadam", instructions=_INSTRUCTIONS)
    for name in TOOLS:
        server.add_tool(_tool(getattr(workspace, name)))
    return server


# Returns the function with errors that the assistant can read.
def _tool(function: Callable[..., dict[str, Any]]) -> Callable[..., dict[str, Any]]:
    @functools.wraps(function)
    def call(*given: Any, **named: Any) -> dict[str, Any]:
        try:
            return function(*given, **named)
        except RequestError as error:
            raise ToolError(str(error)) from None

    return call
