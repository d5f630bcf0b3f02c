"""Plain comments of a header to Doxygen's, on standard output; line numbers stay.

The first comment is that of the file; one on lines of its own belongs to what follows, one behind code to what stands before it. Titles of
sections (---- parts ----) stay plain. Names that are declared together (double a, b;) are taken apart, each with the comment of all. Lists
of X(...) in a struct or an enum are written out, each entry with its strings as its comment.
"""
import re
import sys

COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
NAME = r"\**\w+(?:\[\w+\])*"
TOGETHER = re.compile(rf"^( +)((?:const |unsigned |struct )*\w+ )({NAME}(?:,\s+{NAME})+);([ \n]*/\*.*?\*/)?", re.DOTALL | re.MULTILINE)
LIST = re.compile(r"^#define (\w+)\(X\)((?:.*\\\n)*.*\n)", re.MULTILINE)
ENTRY = re.compile(r'X\(((?:"[^"]*"|[^")]|\([^)]*\))*)\)')
ARGUMENT = re.compile(r'\s*("[^"]*"(?:\s*"[^"]*")*|[^,"]+)\s*')


def plain_text(text):
    """Words in angles would be tags, and so on; not in `code` and in lines that are set apart by four blanks."""
    lines = text.split("\n")
    for k, line in enumerate(lines):
        if k > 0 and re.match(r" *\* {5}", line):
            continue
        parts = line.split("`")
        parts[::2] = [re.sub(r'([<>@\\#%&"])', r"\\\1", part) for part in parts[::2]]
        lines[k] = "`".join(parts)
    return "\n".join(lines)


def documented(source):
    def replace(match):
        text = match.group()[2:-2]
        before = source[:match.start()].rpartition("\n")[2]
        if text.startswith(" ----"):
            return match.group()
        if match.start() == 0:
            return "/**" + plain_text(text) + "@file */"
        return ("/**<" if before.strip() else "/**") + plain_text(text) + "*/"

    return COMMENT.sub(replace, source)


def apart(source):
    def replace(match):
        indent, kind, names, comment = match.groups()
        return indent + " ".join(kind + name + ";" + (comment or "") for name in re.split(r",\s+", names))

    return TOGETHER.sub(replace, source)


def written_out(source):
    lists = {name: ENTRY.findall(body.replace("\\\n", "")) for name, body in LIST.findall(source)}

    def replace(match):
        indent, entries, macro = match.groups()
        parameters, text = re.search(rf"^#define {macro}\(([^)]*)\) (.*)$", source, re.MULTILINE).groups()
        return indent + " ".join(entry(parameters.split(", "), text, arguments) for arguments in lists[entries])

    def entry(parameters, text, arguments):
        values = [value.strip() for value in ARGUMENT.findall(arguments)]
        for parameter, value in zip(parameters, values):
            text = re.sub(rf"\b{parameter}\b", value, text)
        words = [value.strip('"') for value in values if value.startswith('"') and value != '""']
        return text + " /* " + "; ".join(words) + " */"

    source = re.sub(r"^( +)(HCI_\w+)\((HCI_\w+)\)$", replace, source, flags=re.MULTILINE)
    # #define and #undef of what an entry becomes, which is nobody's business
    return re.sub(r"^#define (\w+)\(.*\)(?= )[^\\\n]*$(?=(?:.*\n){2}#undef \1$)|^#undef .*$", "", source, flags=re.MULTILINE)


with open(sys.argv[1], encoding="utf-8") as header:
    sys.stdout.reconfigure(encoding="utf-8")
    sys.stdout.write(apart(documented(written_out(header.read()))))
