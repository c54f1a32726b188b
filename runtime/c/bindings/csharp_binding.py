# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
"""Writes the C API as a C# source file: P/Invoke, without unsafe code."""
import itertools

from calls import describe_call, is_handle, join_words, list_defaults, name_place
from c_header import VULKAN_TYPES, HeaderError

_PRIMITIVES = {
    "void": "void", "char": "byte", "unsigned char": "byte", "int": "int", "float": "float",
    "double": "double", "size_t": "UIntPtr", "pointer": "IntPtr", "int8_t": "sbyte", "uint8_t": "byte",
    "int16_t": "short", "uint16_t": "ushort", "int32_t": "int", "uint32_t": "uint", "int64_t": "long",
    "uint64_t": "ulong"}

_KEYWORDS = set("""abstract as base bool break byte case catch char checked class const continue decimal
    default delegate do double else enum event explicit extern false finally fixed float for foreach goto if
    implicit in int interface internal is lock long namespace new null object operator out override params
    private protected public readonly ref return sbyte sealed short sizeof stackalloc static string struct
    switch this throw true try typeof uint ulong unchecked unsafe ushort using virtual void volatile
    while""".split())

_HEAD = '''// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
// C# binding of Hearth {version}, made from its C headers. Names lack the prefix hearth_; fields have their C
// names.
//
// Structs have the layout of C, and Default for HEARTH_..._INIT. A handle or a number that a C function
// writes is returned, several are `out`. A pointer to a struct is `ref`, or an IntPtr for NULL and arrays. A
// failed call throws HearthException. See docs/bindings.md for threads, lifetimes and the garbage collector.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Hearth
{{

/// <summary>A call failed.</summary>
public sealed class HearthException : Exception
{{
    /// <summary>Api.ERROR_...</summary>
    public readonly int Result;

    internal HearthException(int result, string message) : base(message)
    {{
        Result = result;
    }}
}}

/// <summary>Object of the library, which lives until its Destroy or Close: it has no finalizer.</summary>
public abstract class Handle
{{
    internal IntPtr pointer;
    internal Handle owner; // that it was made from

    /// <summary>The C handle; zero once the object is destroyed.</summary>
    public IntPtr Pointer {{ get {{ return pointer; }} }}
}}
'''

_HELPERS = '''
    [ThreadStatic] private static byte[] message_buffer;

    private static byte[] MessageBuffer()
    {
        return message_buffer ?? (message_buffer = new byte[1024]);
    }

    /// <summary>Read zero-terminated UTF-8, such as a callback's message.</summary>
    public static string ReadText(IntPtr text)
    {
        int length = 0;
        while (text != IntPtr.Zero && Marshal.ReadByte(text, length) != 0)
            ++length;
        byte[] bytes = new byte[length];
        if (length > 0)
            Marshal.Copy(text, bytes, 0, length);
        return Encoding.UTF8.GetString(bytes);
    }

    private static byte[] Encode(string text)
    {
        return text == null ? null : Encoding.UTF8.GetBytes(text + "\\0");
    }

    private static IntPtr Address(Handle handle)
    {
        return handle == null ? IntPtr.Zero : handle.pointer;
    }

    private static IntPtr FindOwner<Kind>(Handle handle) where Kind : Handle
    {
        while (handle != null && !(handle is Kind))
            handle = handle.owner;
        return Address(handle);
    }

    private static HearthException Fail(string function, int result, string message)
    {
        return new HearthException(result, message != "" ? message : function + ": " + ResultString(result));
    }

    private static HearthException Fail(string function, int result, byte[] message)
    {
        return Fail(function, result, Encoding.UTF8.GetString(message, 0, Array.IndexOf(message, (byte)0)));
    }
'''


def _csharp_name(name):
    return "@" + name if name in _KEYWORDS else name


def _write_comment(comment, indent):
    if not comment:
        return []
    text = comment.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").split("\n")
    if len(text) == 1:
        return [f"{indent}/// <summary>{text[0]}</summary>"]
    lines = ["<summary>"] + text + ["</summary>"]
    return [f"{indent}/// {line}".rstrip() for line in lines]


class _Parameter:
    """One way to pass a parameter: declared, handed on to the C function, and declared by it."""

    def __init__(self, declared, argument, native):
        self.declared, self.argument, self.native = declared, argument, native


class _Writer:
    def __init__(self, header, libraries):
        self.header, self.libraries = header, libraries
        self.arrays = {}  # name: (element type, dimensions)

    def name_base(self, base):
        base = self.header.aliases.get(base, base)
        base = VULKAN_TYPES.get(base, base)
        return join_words(base) if base in self.header.structs else _PRIMITIVES[base]

    def name_array(self, base, dimensions):
        element = self.name_base(base)
        capitals = {"ushort": "UShort", "uint": "UInt", "ulong": "ULong"}
        name = capitals.get(element, element[:1].upper() + element[1:])
        name += "x".join(str(size) for size in dimensions)
        self.arrays[name] = (element, dimensions)
        return name

    def name_field(self, field):
        c_type = field.type
        if c_type.pointers or c_type.base in self.header.callbacks:
            if field.dimensions:
                raise HeaderError(f"{field.name} is an array of pointers, which the C# binding does not know")
            return "IntPtr"
        if field.dimensions:
            return self.name_array(c_type.base, field.dimensions)
        return self.name_base(c_type.base)

    def write_constants(self):
        lines = []
        for constant in self.header.constants.values():
            lines += _write_comment(constant.comment, "    ")
            kind = _PRIMITIVES[constant.type]
            value = hex(constant.value) if constant.value > 0xFFFF else constant.value
            lines.append(f"    public const {kind} {constant.name.removeprefix('HEARTH_')} = {value};")
        return lines

    def write_handles(self):
        lines = []
        for name, comment in self.header.handles.items():
            lines += [""] + _write_comment(comment, "")
            lines += [f"public sealed class {join_words(name)} : Handle", "{", "}"]
        return lines

    def write_callbacks(self):
        lines = []
        for name, callback in self.header.callbacks.items():
            parameters = []
            for p in callback.parameters:
                is_struct = p.type.pointers == 1 and p.type.base in self.header.structs
                kind = f"ref {self.name_base(p.type.base)}" if is_struct else self.name_field(p)
                parameters.append(f"{kind} {_csharp_name(p.name)}")
            lines += [""] + _write_comment(callback.comment, "")
            lines += ["[UnmanagedFunctionPointer(CallingConvention.Cdecl)]",
                      f"public delegate {self.name_base(callback.result.base)} {join_words(name)}"
                      f"({', '.join(parameters)});"]
        return lines

    def write_structs(self):
        lines = []
        for struct in self.header.structs.values():
            name = join_words(struct.name)
            lines += [""] + _write_comment(struct.comment, "")
            lines += ["[StructLayout(LayoutKind.Sequential)]", f"public struct {name}", "{"]
            for field in struct.fields:
                lines += _write_comment(field.comment, "    ")
                lines.append(f"    public {self.name_field(field)} {_csharp_name(field.name)};")
            defaults = list_defaults(struct.default or [])
            if struct.is_sized:
                size = f"(uint)Marshal.SizeOf(typeof({name}))"
                lines += ["", f"    private static readonly uint Size = {size};"]
            if struct.default is not None:
                lines += ["", f"    /// <summary>{struct.name.upper()}_INIT</summary>",
                          f"    public static {name} Default", "    {", "        get", "        {",
                          f"            {name} value = new {name}();"]
                for place, value in defaults:
                    path, c_type = name_place(self.header, struct, place)
                    if value == "sizeof":
                        value = "Size"
                    elif c_type.base == "float":
                        value = f"{value}f"
                    path = ".".join(_csharp_name(part) for part in path.replace("][", ", ").split("."))
                    lines.append(f"            value.{path} = {value};")
                lines += ["            return value;", "        }", "    }"]
            lines.append("}")
        return lines

    def write_arrays(self):
        lines = []
        for name, (element, dimensions) in self.arrays.items():
            count = 1
            for size in dimensions:
                count *= size
            elements = [f"e{index}" for index in range(count)]
            indices = [f"i{index}" for index in range(len(dimensions))]
            flat, check = indices[0], f"(uint){indices[0]} >= {dimensions[0]}"
            for index, size in zip(indices[1:], dimensions[1:]):
                flat, check = f"({flat}) * {size} + {index}", f"{check} || (uint){index} >= {size}"
            brackets = "".join(f"[{size}]" for size in dimensions)
            lines += ["", f"/// <summary>{element}{brackets} of C.</summary>",
                      "[StructLayout(LayoutKind.Sequential)]", f"public struct {name}", "{",
                      f"    private {element} {', '.join(elements)};", "",
                      f"    public {name}({', '.join(f'{element} {e}' for e in elements)})", "    {"]
            lines += [f"        this.{e} = {e};" for e in elements] + ["    }", ""]
            lines += [f"    public {element} this[{', '.join(f'int {index}' for index in indices)}]", "    {"]
            for accessor, statement in (("get", "return {};"), ("set", "{} = value; return;")):
                lines += [f"        {accessor}", "        {", f"            if ({check})",
                          "                throw new IndexOutOfRangeException();",
                          f"            switch ({flat})", "            {"]
                for index, e in enumerate(elements):
                    label = f"case {index}:" if index + 1 < count else "default:"
                    lines.append(f"            {label} {statement.format(e)}")
                lines += ["            }", "        }"]
            lines += ["    }", "}"]
        return lines

    def list_ways(self, parameter, call):
        """Return the ways to pass a parameter."""
        c_type, name = parameter.type, _csharp_name(parameter.name)
        pointer = _Parameter(f"IntPtr {name}", name, f"IntPtr {name}")
        if parameter.dimensions:
            by_ref = f"ref {self.name_array(c_type.base, parameter.dimensions)} {name}"
            return [_Parameter(by_ref, f"ref {name}", by_ref)]
        if is_handle(self.header, c_type):
            return [_Parameter(f"{join_words(c_type.base)} {name}", f"Address({name})", pointer.native)]
        if c_type.pointers == 0:
            plain = f"{self.name_field(parameter)} {name}"
            return [_Parameter(plain, name, plain)]
        if c_type.base == "char":
            native = f"byte[] {name}"
            return ([_Parameter(f"string {name}", f"Encode({name})", native)] if c_type.is_const
                    else [_Parameter(native, name, native)])
        if c_type.pointers == 2 or c_type.base == "void" or VULKAN_TYPES.get(c_type.base) == "opaque":
            return [pointer]
        by_ref = f"ref {self.name_base(c_type.base)} {name}"
        ways = [_Parameter(by_ref, f"ref {name}", by_ref)]
        return ways if parameter in call.filled else ways + [pointer]

    def write_function(self, function):
        """Return the lines of the C functions, and those of the methods."""
        call = describe_call(self.header, function)
        file = self.libraries[self.header.library_of_function[function.name]]
        result = self.name_base(function.result.base) if not function.result.pointers else "IntPtr"
        natives, methods = [], []
        for ways in itertools.product(*(self.list_ways(p, call) for p in call.passed)):
            way_of_parameter = {p.name: way for p, way in zip(call.passed, ways)}
            arguments, parameters = [], []
            for p in function.parameters:
                way = way_of_parameter.get(p.name) or self.write_hidden(p, call)
                arguments.append(way.argument)
                parameters.append(way.native)
            natives += ["", f'        [DllImport("{file}", CallingConvention = CallingConvention.Cdecl)]',
                        f"        internal static extern {result} {function.name}({', '.join(parameters)});"]
            methods += self.write_method(call, [way.declared for way in ways], ", ".join(arguments))
        return natives, methods

    def write_hidden(self, parameter, call):
        """Pass a parameter that the method does not have: a result, or the buffer of the message."""
        if parameter in call.returned:
            is_made = is_handle(self.header, parameter.type, 2)
            kind = "IntPtr" if is_made else self.name_base(parameter.type.base)
            name = f"made_{parameter.name}" if is_made else _csharp_name(parameter.name)
            return _Parameter("", f"out {name}", f"out {kind} {name}")
        if parameter.name == "message":
            return _Parameter("", "message", "byte[] message")
        return _Parameter("", "(UIntPtr)message.Length", "UIntPtr message_size")

    def write_method(self, call, declared, arguments):
        function = call.function
        invocation = f"Native.{function.name}({arguments})"
        kinds = [join_words(p.type.base) if is_handle(self.header, p.type, 2) else self.name_base(p.type.base)
                 for p in call.returned]
        is_text = function.result.base == "char" and function.result.pointers == 1
        result = "string" if is_text else "void" if call.throws else self.name_base(function.result.base)
        if len(kinds) == 1:
            result = kinds[0]
        else:
            outputs = zip(kinds, call.returned)
            declared = declared + [f"out {kind} {_csharp_name(p.name)}" for kind, p in outputs]
        lines = [""] + _write_comment(function.comment, "    ")
        lines += [f"    public static {result} {join_words(function.name)}({', '.join(declared)})", "    {"]
        if not call.throws:
            statement = f"return ReadText({invocation})" if is_text else (
                invocation if result == "void" else f"return {invocation}")
            return lines + [f"        {statement};", "    }"]
        for kind, p in zip(kinds, call.returned):
            if is_handle(self.header, p.type, 2):
                lines.append(f"        IntPtr made_{p.name};")
            elif len(kinds) == 1:
                lines.append(f"        {kind} {_csharp_name(p.name)};")
        message = '""'
        if call.has_message:
            lines.append("        byte[] message = MessageBuffer();")
            message = "message"
        elif call.error_function:
            source = self.header.functions[call.error_function]
            kind = join_words(source.parameters[0].type.base)
            message = f"ReadText(Native.{source.name}(FindOwner<{kind}>({_csharp_name(call.error_handle)})))"
        lines += [f"        int result = {invocation};", "        if (result != OK)",
                  f'            throw Fail("{function.name}", result, {message});']
        if call.destroyed:
            lines += [f"        if ({call.destroyed} != null)",
                      f"            {call.destroyed}.pointer = IntPtr.Zero;"]
        results = []
        for kind, p in zip(kinds, call.returned):
            owner = f", owner = {_csharp_name(call.owner)}" if call.owner else ""
            results.append(f"new {kind} {{ pointer = made_{p.name}{owner} }}"
                           if is_handle(self.header, p.type, 2) else _csharp_name(p.name))
        if len(results) == 1:
            lines.append(f"        return {results[0]};")
        else:
            lines += [f"        {_csharp_name(p.name)} = {value};" for p, value in zip(call.returned, results)
                      if is_handle(self.header, p.type, 2)]
        return lines + ["    }"]


def write_csharp(header, libraries):
    """Return the text of the source file. libraries: file of each library."""
    version = header.constants["HEARTH_API_VERSION"].value
    writer = _Writer(header, libraries)
    types = writer.write_handles() + writer.write_callbacks() + writer.write_structs()
    natives, methods = [], []
    for function in header.functions.values():
        native_lines, method_lines = writer.write_function(function)
        natives += native_lines
        methods += method_lines
    types += writer.write_arrays()
    lines = types + ["", "/// <summary>The functions and constants of hearth.h.</summary>"]
    lines += ["public static class Api", "{"]
    lines += writer.write_constants() + _HELPERS.rstrip("\n").split("\n") + methods
    lines += ["", "    private static class Native", "    {"] + natives[1:] + ["    }", "}", "", "}"]
    return _HEAD.format(version=f"{version >> 16}.{version & 0xFFFF}") + "\n".join(lines) + "\n"
