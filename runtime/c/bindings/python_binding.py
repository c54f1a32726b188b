# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
"""Writes the C API as a Python module on ctypes."""
import keyword

from calls import describe_call, is_handle, join_words, list_defaults, name_place
from c_header import VULKAN_TYPES, Variable

_PRIMITIVES = {
    "char": "c_char", "unsigned char": "c_ubyte", "int": "c_int", "float": "c_float", "double": "c_double",
    "size_t": "c_size_t", "pointer": "c_void_p",
    **{f"{sign}int{bits}_t": f"c_{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}}

_HEAD = '''# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
"""Python binding of Hearth {version}, made from its C headers. Names lack the prefix hearth_.

Structs have the defaults of HEARTH_..._INIT: Frame(error_pixels=2). Handles and numbers that a C function
writes are returned. Structs that it writes may be left out: scene_get_info(scene) returns one. A failed call
raises Error. Handles and numbers of Vulkan are int. See docs/bindings.md for threads and lifetimes.
"""
import ctypes
import os


class Error(Exception):
    """A call failed. result: ERROR_..."""

    def __init__(self, result, message):
        super().__init__(message)
        self.result = result


class _Struct(ctypes.Structure):
    """Struct that is constructed with its defaults, and has no fields but its own."""
    __slots__ = ()

    def __init__(self, *values, **fields):
        super().__init__()
        self._set_defaults()
        for (name, *_), value in zip(self._fields_, values):
            setattr(self, name, value)
        for name, value in fields.items():
            setattr(self, name, value)

    def _set_defaults(self):
        pass


class _Handle(ctypes.c_void_p):
    """Object of the library; false once it is destroyed. _owner is the handle that it was made from."""
    _owner = None

    @classmethod
    def from_param(cls, value):
        if value is None or isinstance(value, cls):
            return value
        raise TypeError(f"expected {{cls.__name__}}, not {{type(value).__name__}}")


class _Library:
    """Shared library, opened by the first call: HEARTH_..._LIBRARY names another file of it."""

    def __init__(self, file, variable):
        self._file = os.environ.get(variable, file)
        self._functions = {{}}

    def add(self, name, result, *parameters):
        self._functions[name] = (result, parameters)

    def __getattr__(self, name):
        if name not in self._functions:
            raise AttributeError(name)
        if "_library" not in self.__dict__:
            self._library = ctypes.CDLL(self._file)
        function = getattr(self._library, name)
        function.restype, function.argtypes = self._functions[name]
        setattr(self, name, function)
        return function


def _encode(text):
    return None if text is None else os.fsencode(text)


def _fail(function, result, message):
    """Raise Error with the line of the library, or else with the meaning of the result."""
    text = (message or b"").decode(errors="replace")
    raise Error(result, text or f"{{function}}: {{result_string(result)}}")


def _find_owner(handle, kind):
    while handle is not None and not isinstance(handle, kind):
        handle = handle._owner
    return handle

'''


def _python_name(name):
    return name + "_" if keyword.iskeyword(name) else name


def _docstring(comment, indent):
    if not comment:
        return []
    text = comment.replace("\\", "\\\\").replace('"', '\\"').split("\n")
    return [f'{indent}"""{text[0]}'] + [f"{indent}{line}".rstrip() for line in text[1:]] + [f'{indent}"""']


class _Writer:
    def __init__(self, header, libraries):
        self.header, self.libraries = header, libraries

    def name_type(self, variable, is_field):
        """Return the ctypes type of a field or of a parameter."""
        text = self.name_scalar(variable, is_field)
        if variable.dimensions and not is_field:
            return f"ctypes.POINTER({text})"  # C passes the address of an array
        for size in reversed(variable.dimensions):
            text = f"({text} * {size})"
        return text

    def name_scalar(self, variable, is_field):
        c_type, header = variable.type, self.header
        if c_type.pointers == 0:
            return self.name_base(c_type.base)
        if is_handle(header, c_type):
            return join_words(c_type.base)
        if is_handle(header, c_type, 2):
            return f"ctypes.POINTER({join_words(c_type.base)})"
        if c_type.base == "void" or VULKAN_TYPES.get(c_type.base) == "opaque":
            return "ctypes.c_void_p"
        if c_type.base == "char" and c_type.is_const and not is_field:
            return "ctypes.c_char_p"
        return f"ctypes.POINTER({self.name_base(c_type.base)})"

    def name_base(self, base):
        base = self.header.aliases.get(base, base)
        base = VULKAN_TYPES.get(base, base)
        if base in self.header.structs or base in self.header.callbacks:
            return join_words(base)
        return "None" if base == "void" else f"ctypes.{_PRIMITIVES[base]}"

    def write_constants(self):
        lines = []
        for constant in self.header.constants.values():
            lines += [f"# {line}".rstrip() for line in constant.comment.split("\n") if line]
            value = hex(constant.value) if constant.value > 0xFFFF else constant.value
            lines.append(f"{constant.name.removeprefix('HEARTH_')} = {value}")
        return lines

    def write_types(self):
        lines = []
        for name, comment in self.header.handles.items():
            lines += ["", "", f"class {join_words(name)}(_Handle):"]
            lines += _docstring(comment, "    ") or ["    pass"]
        for struct in self.header.structs.values():
            lines += ["", "", f"class {join_words(struct.name)}(_Struct):"]
            lines += _docstring(struct.comment, "    ") + ["    __slots__ = ()"]
            defaults = list_defaults(struct.default or [])
            if defaults:
                lines += ["", "    def _set_defaults(self):"]
            for place, value in defaults:
                value = "ctypes.sizeof(self)" if value == "sizeof" else value
                lines.append(f"        self.{name_place(self.header, struct, place)[0]} = {value}")
        lines += ["", ""]
        # callbacks and structs name each other: fields come once all classes are there, in the order of need
        for name, callback in self.header.callbacks.items():
            result = self.name_scalar(_result(callback), False)
            types = [self.name_type(p, False) for p in callback.parameters]
            lines += [f"# {line}".rstrip() for line in callback.comment.split("\n") if line]
            lines.append(f"{join_words(name)} = ctypes.CFUNCTYPE({', '.join([result] + types)})")
        for struct in self.header.structs.values():
            lines += ["", f"{join_words(struct.name)}._fields_ = ["]
            for field in struct.fields:
                lines += [f"    # {line}".rstrip() for line in field.comment.split("\n") if line]
                lines.append(f'    ("{field.name}", {self.name_type(field, True)}),')
            lines.append("]")
        return lines

    def write_function(self, function):
        call = describe_call(self.header, function)
        library = f"_{self.header.library_of_function[function.name].replace('-', '_')}"
        parameters = [_python_name(p.name) for p in call.passed]
        filled = {p.name for p in call.filled}
        is_last = [all(p.name in filled for p in call.passed[index:]) for index in range(len(call.passed))]
        signature = [f"{name}=None" if last else name for name, last in zip(parameters, is_last)]
        lines = ["", "", f"def {call.name}({', '.join(signature)}):"] + _docstring(function.comment, "    ")
        for parameter in call.filled:
            name = _python_name(parameter.name)
            lines.append(f"    {name} = {join_words(parameter.type.base)}() if {name} is None else {name}")
        for parameter in call.returned:
            kind = (join_words(parameter.type.base) if is_handle(self.header, parameter.type, 2)
                    else self.name_base(parameter.type.base))
            lines.append(f"    {_python_name(parameter.name)} = {kind}()")
        if call.has_message:
            lines.append("    message = ctypes.create_string_buffer(1024)")
        arguments = [self.write_argument(p, call) for p in function.parameters]
        invocation = f"{library}.{function.name}({', '.join(arguments)})"
        if not call.throws:
            result = function.result
            is_text = result.base == "char" and result.pointers == 1
            if result.base == "void" and not result.pointers:
                return lines + [f"    {invocation}"]
            return lines + [f"    return {invocation}" + ('.decode(errors="replace")' if is_text else "")]
        lines += [f"    result = {invocation}", "    if result != OK:", f"        {self.write_failure(call)}"]
        if call.destroyed:
            # a handle that is used again fails, in place of reading freed memory
            lines += [f"    if {call.destroyed} is not None:", f"        {call.destroyed}.value = None"]
        if call.owner:
            lines.append(f"    {_python_name(call.returned[0].name)}._owner = {_python_name(call.owner)}")
        numbers = [p.name for p in call.returned if not is_handle(self.header, p.type, 2)]
        results = [_python_name(p.name) + (".value" if p.name in numbers else "")
                   for p in function.parameters if p in call.returned or p in call.filled]
        return lines + ([f"    return {', '.join(results)}"] if results else [])

    def write_argument(self, parameter, call):
        name = _python_name(parameter.name)
        if call.has_message and parameter.name == "message_size":
            return "len(message)"
        if parameter in call.returned:
            return f"ctypes.byref({name})"
        if parameter.type.base == "char" and parameter.type.pointers and parameter.type.is_const:
            return f"_encode({name})"
        return name

    def write_failure(self, call):
        message = "None"
        if call.has_message:
            message = "message.value"
        elif call.error_function:
            source = self.header.functions[call.error_function]
            library = f"_{self.header.library_of_function[source.name].replace('-', '_')}"
            kind = join_words(source.parameters[0].type.base)
            message = f"{library}.{source.name}(_find_owner({_python_name(call.error_handle)}, {kind}))"
        return f'_fail("{call.function.name}", result, {message})'

    def write_libraries(self):
        lines = []
        for library, file in self.libraries.items():
            name = library.replace("-", "_")
            lines.append(f'_{name} = _Library("{file}", "{name.upper()}_LIBRARY")')
        for function in self.header.functions.values():
            name = self.header.library_of_function[function.name].replace("-", "_")
            types = [self.name_scalar(_result(function), False)]
            for p in function.parameters:
                is_buffer = p.type.base == "char" and not p.type.is_const and p.type.pointers
                types.append("ctypes.c_char_p" if is_buffer else self.name_type(p, False))
            lines.append(f'_{name}.add("{function.name}", {", ".join(types)})')
        return lines


def _result(function):
    """Return the result of a function as a variable without a name."""
    return Variable("", function.result)


def write_python(header, libraries):
    """Return the text of the module.

    libraries  file of each library, in the order in which they need each other
    """
    version = header.constants["HEARTH_API_VERSION"].value
    writer = _Writer(header, libraries)
    lines = writer.write_constants() + writer.write_types() + [""] + writer.write_libraries()
    for function in header.functions.values():
        lines += writer.write_function(function)
    return _HEAD.format(version=f"{version >> 16}.{version & 0xFFFF}") + "\n".join(lines) + "\n"
