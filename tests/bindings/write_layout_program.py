# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
"""write_layout_program.py FOLDER OUT.c HEADER...: write a C program that prints the layout, the defaults and
the constants that the C compiler gives to what c_header.py, in FOLDER, has read. It compiles only if the
functions have the types that were read."""
import os
import sys

folder, output, *paths = sys.argv[1:]
sys.path.insert(0, folder)
import c_header  # noqa: E402


def spell(variable):
    """Return the C type of a parameter or a result."""
    if variable.dimensions:  # C passes its address
        return f"{'const ' if variable.type.is_const else ''}{variable.type.base} *"
    text = ("const " if variable.type.is_const else "") + variable.type.base
    if variable.type.pointers == 2 and variable.type.is_const:
        return text + " *const *"
    return text + " " + "*" * variable.type.pointers


def compare_function(function, declared):
    parameters = ", ".join(spell(p) for p in function.parameters) or "void"
    result = spell(c_header.Variable("", function.result))
    return (f"_Static_assert(__builtin_types_compatible_p({declared}, {result} (*)({parameters})), "
            f'"{function.name}");')


header = None
for path in paths:
    header = c_header.read_header(path, "", header)

lines = ["/* Made by write_layout_program.py. */"]
lines += [f'#include "{os.path.basename(path)}"' for path in paths]
lines += ["#include <stdio.h>", ""]
for name, kind in c_header.VULKAN_TYPES.items():
    if kind != "opaque":
        kind = "void*" if kind == "pointer" else kind
        lines.append(f'_Static_assert(sizeof({name}) == sizeof({kind}), "{name}");')
for function in header.functions.values():
    lines.append(compare_function(function, f"__typeof__(&{function.name})"))
for callback in header.callbacks.values():
    struct, _, field = callback.field.partition(".")
    declared = f"__typeof__((({struct}*)0)->{field})" if field else callback.name
    lines.append(compare_function(callback, declared))
lines += ["", "static void print_bytes(const char* name, const void* value, size_t size)", "{",
          "    size_t i;",
          '    printf("default %s ", name);', "    for (i = 0; i < size; ++i)",
          '        printf("%02x", ((const unsigned char*)value)[i]);', '    printf("\\n");', "}", ""]
sized = [s for s in header.structs.values() if s.default is not None]
lines += [f"static const {s.name} {s.name}_default = {s.name.upper()}_INIT;" for s in sized]
lines += ["", "int main(void)", "{"]
for struct in header.structs.values():
    lines.append(f'    printf("struct {struct.name} %zu\\n", sizeof({struct.name}));')
    for field in struct.fields:
        place, size = f"offsetof({struct.name}, {field.name})", f"sizeof((({struct.name}*)0)->{field.name})"
        lines.append(f'    printf("field {struct.name}.{field.name} %zu %zu\\n", {place}, {size});')
lines += [f'    print_bytes("{s.name}", &{s.name}_default, sizeof({s.name}));' for s in sized]
lines += [f'    printf("constant {name} %lld\\n", (long long){name});' for name in header.constants]
lines += ["    return 0;", "}"]
with open(output, "w", encoding="utf-8") as file:
    file.write("\n".join(lines) + "\n")
