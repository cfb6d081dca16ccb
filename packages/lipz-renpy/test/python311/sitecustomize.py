"""Lets Ren'Py 8.0 run on Python 3.11, which checks the line numbers of syntax trees. Ren'Py computes wrong ones."""

import ast
import builtins

_compile = builtins.compile


def compile(source, *args, **kwargs):
    for node in ast.walk(source) if isinstance(source, ast.AST) else ():
        if getattr(node, "end_lineno", None) is not None:
            start, end = (node.lineno, node.col_offset), (node.end_lineno, node.end_col_offset)
            node.end_lineno, node.end_col_offset = max(start, end)
    return _compile(source, *args, **kwargs)


builtins.compile = compile
