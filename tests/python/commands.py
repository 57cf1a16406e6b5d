"""The commands that documents print."""

import re

BLOCK = re.compile(r"(?:<!-- file: (?P<file>\S+) -->\n)?```(?P<kind>\w+)\n(?P<text>.*?)```", re.S)


def printed(text):
    """Returns the commands of a block, as a shell takes them: a line that ends in a backslash goes on."""
    return text.replace("\\\n", " ").splitlines()
