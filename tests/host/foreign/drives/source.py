"""What emitted C and C++ source does when it is compiled: its function at many angles, beside the second implementation."""
import re
import shutil
import subprocess


def rows(path):
    """The numbers between the braces of the table."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    table = text[text.index("= {") + 3:text.index("};")]
    return [[float(cell.rstrip("f")) for cell in row.split(",")] for row in re.findall(r"\{([^{}]*)\}", table)]


def run(compiler, folder, files, main):
    """Compiles `main` with `files` beside it; what it prints, line by line as numbers. None: there is no compiler."""
    if shutil.which(compiler) is None:
        return None
    for name, text in {**files, main[0]: main[1]}.items():
        with open(folder + "/" + name, "w", encoding="utf-8") as file:
            file.write(text)
    program = folder + "/feed"
    subprocess.run([compiler, "-Wall", "-Wextra", "-Wno-unused-function", "-Werror", "-ffp-contract=off", "-I", folder, "-o", program, folder + "/" + main[0], "-lm"],
                   check=True)
    done = subprocess.run([program], capture_output=True, text=True, check=True)
    return [[float(cell) for cell in line.split()] for line in done.stdout.splitlines()]
