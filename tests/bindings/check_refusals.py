# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
"""check_refusals.py FOLDER: c_header.py and calls.py, in FOLDER, refuse what bindings cannot have."""
import sys
import tempfile

sys.path.insert(0, sys.argv[1])
import c_header  # noqa: E402
import calls  # noqa: E402

HEAD = "#define HEARTH_API_VERSION 1u\ntypedef struct hearth_a hearth_a;\n"
SIZED = HEAD + "typedef struct hearth_s\n{\n    uint32_t struct_size;\n    float x[2];\n} hearth_s;\n"
CASES = (
    (HEAD + "union hearth_u { int a; };\n", "bad.h:3: "),
    (HEAD + "static inline int hearth_f(void) { return 1; }\n", "bad.h:3: "),
    (HEAD + "extern int hearth_x;\n", "bad.h:3: "),
    (HEAD + "enum\n{\n    HEARTH_A = 1,\n    A = 2\n};\n", "bad.h:6: "),
    (HEAD + "enum\n{\n    HEARTH_A = sizeof(int)\n};\n", "bad.h:5: "),
    (HEAD + "enum\n{\n    HEARTH_A\n};\n", "bad.h:6: "),
    (HEAD + "#define HEARTH_FLASH\n", "bad.h:3: "),
    (HEAD + "HEARTH_API int hearth_f(void (*call)(int a));\n", "bad.h:3: "),
    (HEAD + "enum hearth_e { HEARTH_A };\n", "bad.h:3: "),
    (HEAD + "#if HEARTH_API_VERSION > 1\n#endif\n", "bad.h:3: "),
    (HEAD + "#define HEARTH_TWICE(x) (2 * (x))\n", "bad.h:3: "),
    (HEAD + "/* a comment\n * of two lines */ HEARTH_API int hearth_f(VkStrange value);\n",
     "bad.h:4: unknown type VkStrange: add it to VULKAN_TYPES"),
    (HEAD + "HEARTH_API int hearth_f(hearth_b* value);\n", "bad.h:3: unknown type hearth_b: declare it"),
    (HEAD + "HEARTH_API int hearth_f(hearth_a value);\n", "bad.h:3: hearth_a with 0 '*'"),
    (HEAD + "HEARTH_API int hearth_f(float** value);\n", "bad.h:3: float with 2 '*'"),
    (HEAD + "HEARTH_API int hearth_f(int count, ...);\n", "bad.h:3: "),
    (HEAD + "HEARTH_API int hearth_f(int a);\nHEARTH_API int hearth_f(int a);\n", "bad.h:4: hearth_f exists"),
    (HEAD + "HEARTH_API int hearth_f(int count, hearth_a** things);\n", "hearth_f: things may be an array"),
    (HEAD + "HEARTH_API int hearth_f(int a)", "bad.h:3: the header ends"),
    (HEAD + "HEARTH_API int hearth_f(int a) __attribute__((pure));\n", "bad.h:3: "),
    (HEAD + "typedef struct hearth_s { uint32_t bits : 3; } hearth_s;\n", "bad.h:3: "),
    (HEAD + "typedef struct hearth_s { struct { int a; } b; } hearth_s;\n", "bad.h:3: "),
    (SIZED, "hearth_s has a size and no HEARTH_S_INIT"),
    (SIZED + "#define HEARTH_S_INIT {sizeof(hearth_s), {0, 0, 0}}\n", "bad.h:8: HEARTH_S_INIT: an array has"),
    (SIZED + "#define HEARTH_S_INIT {sizeof(hearth_s), {HEARTH_B}}\n", "bad.h:8: cannot compute 'HEARTH_B'"),
    (SIZED + "#define HEARTH_S_INIT {sizeof(hearth_s), {0}, 1}\n", "bad.h:8: HEARTH_S_INIT: hearth_s has 2"),
    (SIZED + "#define HEARTH_S_INIT {0.5f, {0}}\n", "bad.h:8: HEARTH_S_INIT: 0.5f is no integer"),
    (SIZED + "#define HEARTH_T_INIT {0}\n", "bad.h:8: HEARTH_T_INIT belongs to no struct"),
)

with tempfile.TemporaryDirectory() as folder:
    path = folder + "/bad.h"
    for text, expected in CASES:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        try:
            header = c_header.read_header(path, "bad")
            for function in header.functions.values():
                calls.describe_call(header, function)
            print(f"not refused: {text}")
        except c_header.HeaderError as error:
            if expected not in str(error):
                print(f"{text}: {error}")
