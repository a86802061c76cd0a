"""Parses files of Julia by the grammar of tree-sitter; names the first mistake of each."""

import sys
from pathlib import Path

import tree_sitter_julia
from tree_sitter import Language, Parser


def mistakes(node):
    if node.is_error or node.is_missing:
        yield node
    elif node.has_error:
        for child in node.children:
            yield from mistakes(child)


def main(paths):
    parser = Parser(Language(tree_sitter_julia.language()))
    # A grammar that took anything would say nothing.
    if not parser.parse(b"function f(x)\n    y = x *\nend\n").root_node.has_error:
        sys.exit("the grammar takes what is no Julia")
    wrong = 0
    for path in paths:
        source = Path(path).read_bytes()
        first = next(mistakes(parser.parse(source).root_node), None)
        if first is not None:
            line = first.start_point[0]
            print(f"{path}:{line + 1}: no Julia: {source.splitlines()[line].decode()}")
            wrong += 1
    print(f"Julia: {len(paths) - wrong} of {len(paths)} files are parsed")
    return wrong > 0 or not paths


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
