"""The part of Unreal's header tool that the plugin needs: checks its headers, and writes *.generated.h.

usage: header_tool.py OUT HEADER...
"""

import re
import sys
from pathlib import Path

# The types that reflected properties, parameters and results may have.
TYPES = {
    *("void", "bool", "float", "double", "uint8", "int32", "int64", "FString", "FName", "FText"),
    *("ULipzBank", "USkeletalMeshComponent", "UAudioComponent", "USoundBase", "UStringTable", "UAssetImportData"),
    *("AActor", "ULipzPlayerComponent", "FLipzEvent", "ELipzVerb"),
    *("FLipzEventSignature", "FLipzSubtitleSignature", "FLipzFinishedSignature"),
}
WORDS = {"const", "class", "static", "virtual", "TObjectPtr", "TArray", "TMap"}


def types_of(declaration):
    """The names of all types in `const TMap<FName, float>&`."""
    return set(re.findall(r"\w+", declaration)) - WORDS


def check(path):
    """The problems of a header, and what its generated header contains."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", lambda match: "\n" * match[0].count("\n"), path.read_text("utf-8"), flags=re.S)
    lines = text.split("\n")
    problems, generated, reflected = [], [], []
    includes = re.findall(r'#include "([^"]+)"', text)
    is_reflected = re.search(r"\b(UCLASS|USTRUCT|UENUM)\(", text)
    if is_reflected and includes[-1] != f"{path.stem}.generated.h":
        problems.append(f"the last include must be {path.stem}.generated.h")
    for match in re.finditer(r"\b(UCLASS|USTRUCT)\([^\n]*\)\s*\n(class|struct) (\w+_API )?(\w+)([^{;]*)\{\s*(\w+)?", text):
        name, parents = match[4], re.findall(r"public (\w+)", match[5])
        if match[3] is None:
            problems.append(f"{name} is not exported")
        if match[6] != "GENERATED_BODY":
            problems.append(f"{name} does not start with GENERATED_BODY()")
            continue
        line = text.count("\n", 0, match.start(6)) + 1
        content = f"STUB_CLASS({name}, {parents[0]}) private:" if match[1] == "UCLASS" else ""
        generated.append(f"#define {path.stem}_{line}_GENERATED_BODY {content}")
    properties = set()
    for match in re.finditer(r"\bUPROPERTY\(([^\n]*)\)\s*\n\s*([^;=]+?)\s*(\w+)\s*(=[^;]*)?;", text):
        reflected.append((match[3], match[2]))
        properties.add(match[3])
        if re.search(r"Blueprint|Edit|Visible", match[1]) and "Category" not in match[1]:
            problems.append(f"{match[3]} has no Category")
    for match in re.finditer(r"\bUFUNCTION\(([^\n]*)\)\s*\n\s*([^;{(]+?)\s*(\w+)\(([^)]*)\)", text):
        reflected.append((match[3], match[2]))
        if "Blueprint" in match[1] and "Category" not in match[1]:
            problems.append(f"{match[3]} has no Category")
        for parameter in re.split(r",(?![^<]*>)", match[4]) if match[4].strip() else []:
            declared, name = parameter.strip().rsplit(" ", 1)
            reflected.append((f"{match[3]}: {name}", declared))
            if name in properties:
                problems.append(f"{match[3]}: the parameter {name} has the name of a property")
    for match in re.finditer(r"DELEGATE_OneParam\((\w+), ([^,]+), (\w+)\)", text):
        reflected.append((match[1], match[2]))
    for name, declaration in reflected:
        for unknown in sorted(types_of(declaration) - TYPES):
            problems.append(f"{name}: {unknown} cannot be reflected")
    count = len(re.findall(r"\b(?:UPROPERTY|UFUNCTION)\(", text))
    found = len([name for name, _ in reflected if ":" not in name]) - len(re.findall(r"DELEGATE_OneParam\(", text))
    if count != found:
        problems.append(f"only {found} of {count} reflected members were recognised")
    problems += [f"line {number} is too long" for number, line in enumerate(lines, 1) if len(line.expandtabs(4)) > 130]
    body = [f"#undef CURRENT_FILE_ID", f"#define CURRENT_FILE_ID {path.stem}", *generated]
    return problems, "\n".join(body) + "\n" if is_reflected else None, count


def main(out, *headers):
    failed, members = False, 0
    for path in map(Path, headers):
        problems, generated, count = check(path)
        members += count
        for problem in problems:
            failed = True
            print(f"{path}: {problem}", file=sys.stderr)
        if generated is not None:
            Path(out, f"{path.stem}.generated.h").write_text(generated, "utf-8")
    if failed:
        sys.exit(1)
    print(f"headers: {len(headers)}, with {members} reflected members")


if __name__ == "__main__":
    main(*sys.argv[1:])
