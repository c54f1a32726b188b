# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
"""Reads headers of Hearth's C API: constants, handles, structs with their defaults, callbacks, functions.

It knows the C that these headers are written in, and refuses the rest with the line, so that nothing of a
header is lost silently.
"""
import dataclasses
import re


class HeaderError(Exception):
    """One line: file, line, reason, remedy."""


@dataclasses.dataclass(frozen=True)
class Type:
    """`const base *...`: is_const belongs to what the pointer points to."""
    base: str
    pointers: int = 0
    is_const: bool = False


@dataclasses.dataclass
class Variable:
    """Field of a struct, or parameter. A function pointer has a callback in place of a type's base."""
    name: str
    type: Type
    dimensions: tuple = ()
    comment: str = ""


@dataclasses.dataclass
class Struct:
    name: str
    fields: list
    comment: str = ""
    default: object = None  # of HEARTH_..._INIT: a list, nested as the struct is; None: all zero

    @property
    def is_sized(self):
        return bool(self.fields) and self.fields[0].name == "struct_size"


@dataclasses.dataclass
class Function:
    """Function, or the type of a function that the caller provides."""
    name: str
    result: Type
    parameters: list
    comment: str = ""
    field: str = ""  # STRUCT.FIELD whose type it is; "": it has a name in C


@dataclasses.dataclass
class Constant:
    name: str
    value: int
    type: str  # primitive type
    comment: str = ""


@dataclasses.dataclass
class Header:
    """All of the headers read so far; names are unique."""
    constants: dict = dataclasses.field(default_factory=dict)
    aliases: dict = dataclasses.field(default_factory=dict)  # hearth_result: int32_t
    handles: dict = dataclasses.field(default_factory=dict)  # names of opaque structs: their comment
    structs: dict = dataclasses.field(default_factory=dict)
    callbacks: dict = dataclasses.field(default_factory=dict)
    functions: dict = dataclasses.field(default_factory=dict)
    library_of_function: dict = dataclasses.field(default_factory=dict)


PRIMITIVES = """char float double int int8_t int16_t int32_t int64_t size_t uint8_t uint16_t uint32_t uint64_t
    void""".split() + ["unsigned char"]

# Types of vulkan_core.h as bindings see them. The test of layouts compares their sizes with the compiler's.
_VULKAN_TYPES_OF_KIND = {
    "pointer": "PFN_vkGetInstanceProcAddr VkCommandBuffer VkDevice VkInstance VkPhysicalDevice VkQueue",
    "uint64_t": """VkBuffer VkDescriptorSet VkDescriptorSetLayout VkDeviceMemory VkDeviceSize VkFence
        VkFramebuffer VkImage VkImageView VkPipeline VkPipelineCache VkPipelineLayout VkQueryPool VkRenderPass
        VkSampler VkSemaphore VkShaderModule""",
    "int32_t": "VkColorSpaceKHR VkFormat VkImageLayout VkResult",
    "uint32_t": """VkAccessFlags VkBool32 VkFlags VkImageAspectFlags VkImageUsageFlags VkPipelineStageFlags
        VkSampleCountFlags""",
    "opaque": "VkAllocationCallbacks",  # only behind a pointer
}
VULKAN_TYPES = {name: kind for kind, names in _VULKAN_TYPES_OF_KIND.items() for name in names.split()}


def _vulkan_struct(name, **types):
    return Struct(name, [Variable(field, Type(base)) for field, base in types.items()])


VULKAN_STRUCTS = (
    _vulkan_struct("VkMemoryRequirements", size="uint64_t", alignment="uint64_t", memoryTypeBits="uint32_t"),
    _vulkan_struct("VkExtent2D", width="uint32_t", height="uint32_t"),
    _vulkan_struct("VkOffset2D", x="int32_t", y="int32_t"),
    _vulkan_struct("VkRect2D", offset="VkOffset2D", extent="VkExtent2D"),
)

# Constants of other headers that defaults and numbers may name.
KNOWN_CONSTANTS = {"NULL": 0, "VK_NULL_HANDLE": 0, "VK_IMAGE_LAYOUT_UNDEFINED": 0, "VK_FORMAT_UNDEFINED": 0,
                   "UINT32_MAX": 0xFFFFFFFF, "UINT64_MAX": 0xFFFFFFFFFFFFFFFF}

_TOKEN = re.compile(r"""
    (?P<space>[ \t\n]+|\\\n)
  | (?P<comment>/\*.*?\*/|//[^\n]*)
  | (?P<directive>\#(?:/\*.*?\*/|\\\n|[^\n])*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<number>(?:0[xX][0-9A-Fa-f]+|\d+\.\d*(?:[eE][-+]?\d+)?|\d+)[uUlLfF]*)
  | (?P<string>"[^"\n]*")
  | (?P<mark><<|[{}()\[\];,*=|+:-])
""", re.VERBOSE | re.DOTALL)


@dataclasses.dataclass
class Token:
    kind: str
    text: str
    line: int


def _read_tokens(text, path, first_line=1):
    """Return the tokens, comments included, spaces not."""
    tokens, at, line = [], 0, first_line
    while at < len(text):
        match = _TOKEN.match(text, at)
        # a directive is one only at the beginning of a line
        if match is None or (match.lastgroup == "directive" and text[:at].rpartition("\n")[2].strip()):
            raise HeaderError(f"{path}:{line}: cannot read {text[at:].split()[0]!r}: "
                              "write it in the C of the lines around it, or teach c_header.py")
        if match.lastgroup != "space":
            tokens.append(Token(match.lastgroup, match.group(), line))
        line += match.group().count("\n")
        at = match.end()
    return tokens


def _clean_comment(texts):
    """Return the lines of comments without their marks."""
    lines = []
    for text in texts:
        text = text[2:].removesuffix("*/") if text.startswith("/*") else text[2:]
        lines += [re.sub(r"^\s*\* ?", "", line).rstrip() if index else line.strip()
                  for index, line in enumerate(text.split("\n"))]
    return "\n".join(lines).strip()


class _Parser:
    def __init__(self, path, text, header, library):
        self.path, self.header, self.library = path, header, library
        self.tokens = _read_tokens(text, path)
        self.at = 0
        self.comments = []  # before the next token
        self.result_enum = None  # type of the next enum
        self.defaults = []  # name, words and line of each HEARTH_..._INIT

    # -- tokens --

    def fail(self, reason, line=None):
        line = line or (self.tokens[min(self.at, len(self.tokens) - 1)].line if self.tokens else 1)
        raise HeaderError(f"{self.path}:{line}: {reason}")

    def peek(self):
        """Return the next token that is no comment, or None; comments before it become self.comments."""
        while self.at < len(self.tokens) and self.tokens[self.at].kind == "comment":
            self.comments.append(self.tokens[self.at])
            self.at += 1
        return self.tokens[self.at] if self.at < len(self.tokens) else None

    def next(self, expected=None):
        token = self.peek()
        if token is None:
            self.fail(f"the header ends where {expected or 'more'} is expected")
        if expected is not None and token.text != expected:
            self.fail(f"found {token.text!r} where {expected!r} is expected: write it in the C of the lines "
                      "around it, or teach c_header.py")
        self.at += 1
        return token

    def accept(self, text):
        token = self.peek()
        if token is not None and token.text == text:
            return self.next()
        return None

    def take_name(self, kind):
        token = self.next()
        if token.kind != "name":
            self.at -= 1
            self.fail(f"found {token.text!r} where the name of a {kind} is expected")
        return token.text

    def take_comment(self):
        """Return the comment before the next token, and forget it."""
        self.peek()
        text = _clean_comment([token.text for token in self.comments])
        self.comments = []
        return text

    def add_trailing_comment(self, comment, line):
        """Add the comment that follows on the same line, if there is one."""
        if self.at < len(self.tokens):
            token = self.tokens[self.at]
            if token.kind == "comment" and token.line == line:
                self.at += 1
                comment = (comment + "\n" + _clean_comment([token.text])).strip()
        return comment

    # -- numbers --

    def evaluate(self, tokens):
        """Return the value of an expression of integers, |, << and parentheses."""
        text = ""
        for token in tokens:
            if token.kind == "number" and re.fullmatch(r"(0[xX][0-9A-Fa-f]+|\d+)[uUlL]*", token.text):
                text += str(int(token.text.rstrip("uUlL"), 0))
            elif token.kind == "name" and token.text in self.header.constants:
                text += str(self.header.constants[token.text].value)
            elif token.kind == "name" and token.text in KNOWN_CONSTANTS:
                text += str(KNOWN_CONSTANTS[token.text])
            elif token.text in ("|", "<<", "(", ")", "-", "+"):
                text += token.text
            else:
                self.fail(f"cannot compute {token.text!r}", token.line)
        try:
            return eval(text, {"__builtins__": {}})  # of digits and the marks above alone
        except SyntaxError:
            self.fail(f"cannot compute {text!r}", tokens[0].line if tokens else None)

    def add_constant(self, name, value, c_type, comment):
        if name in self.header.constants:
            self.fail(f"{name} exists twice")
        self.header.constants[name] = Constant(name, value, c_type, comment)

    # -- preprocessor --

    def read_directive(self):
        comment = self.take_comment()
        token = self.next()
        text = token.text.replace("\\\n", "\n")
        known_headers = r'<(stddef|stdint|vulkan/vulkan_core)\.h>|"hearth\.h"'
        if text == "#endif" or re.fullmatch(rf"#include\s+({known_headers})", text):
            return
        if re.fullmatch(r"#(ifndef|define) HEARTH_(\w+_)?H\s*", text):  # include guard
            return
        if text == "#ifdef __cplusplus":
            self.skip_linkage()
            return
        define = re.match(r"#define (HEARTH_\w+)(?=\s)(.*)", text, re.DOTALL)
        if define is None:
            self.fail(f"cannot read {text.splitlines()[0]!r}: only integers and HEARTH_..._INIT are defined",
                      token.line)
        name = define.group(1)
        words = [word for word in _read_tokens(define.group(2), self.path, token.line)
                 if word.kind != "comment"]
        if name.endswith("_INIT"):
            self.defaults.append((name, words, token.line))
        else:
            is_unsigned = any(re.search("[uU]", word.text) for word in words if word.kind == "number")
            self.add_constant(name, self.evaluate(words), "uint32_t" if is_unsigned else "int32_t", comment)

    def skip_linkage(self):
        """Skip the two definitions of HEARTH_API."""
        for expected in ("#define HEARTH_API ", "#else", "#define HEARTH_API ", "#endif"):
            token = self.next()
            if not token.text.startswith(expected):
                self.fail(f"found {token.text!r} where {expected!r} is expected", token.line)

    # -- types --

    def read_type(self):
        is_const = self.accept("const") is not None
        base = self.take_name("type")
        if base == "unsigned":
            base += " " + self.next("char").text
        if not is_const:
            is_const = self.accept("const") is not None
        header = self.header
        declared = (header.aliases, header.handles, header.structs, header.callbacks)
        if not any(base in known for known in (PRIMITIVES, VULKAN_TYPES, *declared)):
            self.at -= 1
            remedy = ("add it to VULKAN_TYPES of c_header.py" if base.startswith(("Vk", "PFN_vk"))
                      else "declare it above")
            self.fail(f"unknown type {base}: {remedy}")
        pointers = 0
        while self.accept("*"):
            pointers += 1
            if self.accept("const") and pointers > 1:
                self.fail("a constant pointer is unknown here")
        is_opaque = base in header.handles or VULKAN_TYPES.get(base) == "opaque"
        if pointers > 2 or (is_opaque and pointers == 0):
            self.fail(f"{base} with {pointers} '*': bindings know no such type")
        if pointers == 2 and base not in header.handles:
            self.fail(f"{base} with 2 '*': only handles have that")
        return Type(base, pointers, is_const)

    def read_fields(self, struct):
        """Read `TYPE a, b[3]` or `RESULT (*a)(...)`, which gets a type with a name."""
        declared = self.read_type()
        if self.accept("("):
            self.next("*")
            name = self.take_name("function pointer")
            self.next(")")
            callback = f"{struct}_{name}_callback"
            if callback in self.header.callbacks:
                self.fail(f"{callback} exists twice")
            self.header.callbacks[callback] = Function(callback, declared, self.read_parameters(),
                                                       field=f"{struct}.{name}")
            return [Variable(name, Type(callback))]
        fields = [self.read_declarator(declared)]
        while self.accept(","):
            fields.append(self.read_declarator(declared))
        return fields

    def read_declarator(self, declared):
        name = self.take_name("variable")
        dimensions = []
        while self.accept("["):
            size = []
            while self.peek() is not None and self.peek().text != "]":
                size.append(self.next())
            self.next("]")
            dimensions.append(self.evaluate(size))
        if declared.base == "void" and declared.pointers == 0:
            self.fail(f"{name} has no type")
        return Variable(name, declared, tuple(dimensions))

    def read_parameters(self):
        self.next("(")
        parameters = []
        if [token.text for token in self.tokens[self.at:self.at + 2]] == ["void", ")"]:
            self.next()
        while not self.accept(")"):
            parameters.append(self.read_declarator(self.read_type()))
            if self.peek() is None or self.peek().text != ")":
                self.next(",")
        return parameters

    # -- declarations --

    def read_enum(self):
        self.next("enum")
        self.next("{")
        c_type, self.result_enum = self.result_enum or "uint32_t", None
        self.comments = []
        while not self.accept("}"):
            comment = self.take_comment()
            token = self.next()
            if token.kind != "name" or not token.text.startswith("HEARTH_"):
                self.fail(f"found {token.text!r} where a constant HEARTH_... is expected", token.line)
            self.next("=")
            words = []
            while self.peek() is not None and self.peek().text not in (",", "}"):
                words.append(self.next())
            value = self.evaluate(words)
            line = self.tokens[self.at - 1].line
            if self.peek() is None or self.peek().text != "}":
                line = self.next(",").line
            self.add_constant(token.text, value, c_type, self.add_trailing_comment(comment, line))
        self.next(";")

    def read_typedef(self):
        comment = self.take_comment()
        self.next("typedef")
        if self.accept("struct"):
            name = self.take_name("struct")
            if self.accept("{"):
                self.read_struct(name, comment)
            else:
                self.next(name)
                comment = self.add_trailing_comment(comment, self.next(";").line)
                self.header.handles[name] = comment
            return
        declared = self.read_type()
        if self.accept("("):
            self.next("*")
            name = self.take_name("callback")
            self.next(")")
            self.header.callbacks[name] = Function(name, declared, self.read_parameters(), comment)
        else:
            name = self.take_name("type")
            if declared.pointers or declared.base not in PRIMITIVES:
                self.fail(f"{name} is no name of a number")
            self.header.aliases[name] = declared.base
            self.result_enum = declared.base
        self.next(";")

    def read_struct(self, name, comment):
        struct = Struct(name, [], comment)
        while not self.accept("}"):
            note = self.take_comment()
            fields = self.read_fields(name)
            fields[0].comment = self.add_trailing_comment(note, self.next(";").line)
            struct.fields += fields
        self.next(name)
        self.next(";")
        if not struct.fields:
            self.fail(f"{name} is empty")
        if name in self.header.structs:
            self.fail(f"{name} exists twice")
        self.header.structs[name] = struct

    def read_function(self):
        comment = self.take_comment()
        self.next("HEARTH_API")
        result = self.read_type()
        name = self.take_name("function")
        if name in self.header.functions:
            self.fail(f"{name} exists twice")
        self.header.functions[name] = Function(name, result, self.read_parameters(), comment)
        self.header.library_of_function[name] = self.library
        self.next(";")

    def read_all(self):
        readers = {"enum": self.read_enum, "typedef": self.read_typedef, "HEARTH_API": self.read_function}
        while (token := self.peek()) is not None:
            # only the comment that ends on the line before a declaration is about it
            self.comments = [comment for comment in self.comments
                             if comment.line + comment.text.count("\n") + 1 >= token.line][-1:]
            if token.kind == "directive":
                self.read_directive()
            elif token.text in readers:
                readers[token.text]()
            else:
                self.fail(f"found {token.text!r} where a declaration is expected: enum, typedef or "
                          "HEARTH_API")
            self.comments = []
        for name, words, line in self.defaults:
            self.read_default(name, words, line)
        for struct in self.header.structs.values():
            if struct.is_sized and struct.default is None:
                self.fail(f"{struct.name} has a size and no {struct.name.upper()}_INIT", 1)

    # -- defaults --

    def read_default(self, name, words, line):
        struct = self.header.structs.get(name.removesuffix("_INIT").lower())
        if struct is None:
            self.fail(f"{name} belongs to no struct", line)
        rest = list(words)
        tree = self.read_initializer(rest, line)
        if rest:
            self.fail(f"{name}: found {rest[0].text!r} behind its end", rest[0].line)
        struct.default = self.fit_struct(struct, tree, name, line)

    def read_initializer(self, rest, line):
        """Return a nested list of lists of words."""
        if not rest:
            self.fail("a default ends early", line)
        if rest[0].text != "{":
            words, depth = [], 0
            while rest and (depth or rest[0].text not in (",", "}")):
                depth += {"(": 1, ")": -1}.get(rest[0].text, 0)
                words.append(rest.pop(0))
            nested = [entry for entry in self.defaults if len(words) == 1 and entry[0] == words[0].text]
            return self.read_initializer(list(nested[0][1]), line) if nested else tuple(words)
        rest.pop(0)
        values = []
        while rest and rest[0].text != "}":
            values.append(self.read_initializer(rest, line))
            if rest and rest[0].text == ",":
                rest.pop(0)
        if not rest:
            self.fail("a default lacks '}'", line)
        rest.pop(0)
        return values

    def fit_struct(self, struct, tree, name, line):
        if not isinstance(tree, list) or len(tree) > len(struct.fields):
            self.fail(f"{name}: {struct.name} has {len(struct.fields)} fields", line)
        values = [self.fit(field.type, field.dimensions, value, name, line)
                  for field, value in zip(struct.fields, tree)]
        return values + [0] * (len(struct.fields) - len(values))

    def fit(self, c_type, dimensions, tree, name, line):
        """Return the value of a field: a number, "sizeof", or a list; 0 is any field without bits."""
        if dimensions:
            if not isinstance(tree, list) or len(tree) > dimensions[0]:
                self.fail(f"{name}: an array has {dimensions[0]} elements in braces", line)
            values = [self.fit(c_type, dimensions[1:], value, name, line) for value in tree]
            return values + [0] * (dimensions[0] - len(values))
        if c_type.pointers == 0 and c_type.base in self.header.structs:
            return self.fit_struct(self.header.structs[c_type.base], tree, name, line)
        if isinstance(tree, list) or not tree:
            self.fail(f"{name}: a number is expected", line)
        if tree[0].text == "sizeof":
            return "sizeof"
        sign, words = (-1, tree[1:]) if tree[0].text == "-" else (1, tree)
        if len(words) == 1 and words[0].kind == "number" and re.search(r"[.fF]", words[0].text) and not (
                words[0].text.startswith(("0x", "0X"))):
            if c_type.base not in ("float", "double"):
                self.fail(f"{name}: {words[0].text} is no integer", line)
            return sign * float(words[0].text.rstrip("fF"))
        value = self.evaluate(list(tree))
        if value and (c_type.pointers or c_type.base in self.header.callbacks):
            self.fail(f"{name}: a pointer is NULL", line)
        return value


def read_header(path, library, header=None):
    """Read a header into `header`, or into a new one.

    library  the library that has its functions
    raises   HeaderError at the first declaration that bindings cannot have
    """
    if header is None:
        header = Header()
        header.structs = {struct.name: struct for struct in VULKAN_STRUCTS}
    with open(path, encoding="utf-8") as file:
        _Parser(path, file.read(), header, library).read_all()
    return header
