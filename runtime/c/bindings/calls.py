# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
"""Works out how languages with exceptions call a function of the C API: results returned, errors thrown.

All of it follows from names and types, by the rules of hearth.h, so that new functions need no list.
"""
import dataclasses
import re

from c_header import HeaderError


@dataclasses.dataclass
class Call:
    """A function, its parameters sorted."""
    function: object
    passed: list  # parameters of the binding, in order
    returned: list  # handles and numbers that the C function writes: the binding returns them
    filled: list  # structs of `passed` that the C function writes and that the caller may leave out
    throws: bool  # it returns hearth_result
    has_message: bool  # it writes the message of an error to `message`
    error_function: str = ""  # else: function that returns the message of an error, or ""
    error_handle: str = ""  # else: parameter to ask it about, or whose owner to ask
    owner: str = ""  # parameter that a returned handle was made from
    destroyed: str = ""  # parameter that the call destroys

    @property
    def name(self):
        return self.function.name.removeprefix("hearth_")


def is_handle(header, c_type, pointers=1):
    return c_type.base in header.handles and c_type.pointers == pointers


def makes_handle(header, c_type):
    return is_handle(header, c_type, 2) and not c_type.is_const


def _owner_types(header):
    """Return the kind of handle that each kind is made from: that of its creator's first handle, or ""."""
    owners = {}
    for function in header.functions.values():
        used = [p.type.base for p in function.parameters if is_handle(header, p.type)]
        for kind in (p.type.base for p in function.parameters if makes_handle(header, p.type)):
            owners.setdefault(kind, used[0] if used else "")
    return owners


def _find_error_source(header, function):
    """Return the function that returns messages of this function's errors, and the handle's parameter."""
    handles = [p for p in function.parameters if is_handle(header, p.type)]
    if not handles:
        return "", ""
    kind, owners = handles[0].type.base, _owner_types(header)
    own = f"{kind}_last_error"
    if own in header.functions:
        return own, handles[0].name
    # hearth_last_error returns the errors of a renderer and of all that is made from it
    shared = header.functions.get("hearth_last_error")
    root = shared.parameters[0].type.base if shared else None
    while kind and kind != root:
        kind = owners.get(kind, "")
    return ("hearth_last_error", handles[0].name) if kind else ("", "")


def describe_call(header, function):
    """Sort the parameters of a function.

    A pointer that the function writes through points to one object, which the binding returns, except in
    functions with a count or a size: there it may be an array, and the caller provides it.
    """
    parameters = list(function.parameters)
    has_message = [p.name for p in parameters[-2:]] == ["message", "message_size"]
    if has_message:
        parameters = parameters[:-2]
    numbers = [p.name for p in parameters if not p.type.pointers]
    has_count = any(re.search(r"(^|_)(count|size|capacity)$", name) for name in numbers)
    call = Call(function, [], [], [], function.result.base == "hearth_result", has_message)
    for parameter in parameters:
        c_type = parameter.type
        is_written = c_type.pointers > 0 and not c_type.is_const and c_type.base not in ("void", "char")
        if is_handle(header, c_type, 2):
            if is_written and has_count and parameter.name.endswith("s"):
                raise HeaderError(f"{function.name}: {parameter.name} may be an array of new handles, which "
                                  "bindings do not know")
            (call.returned if is_written else call.passed).append(parameter)
        elif is_handle(header, c_type) or not is_written or has_count or parameter.dimensions:
            call.passed.append(parameter)
        elif c_type.base in header.structs:
            call.passed.append(parameter)
            call.filled.append(parameter)
        else:
            call.returned.append(parameter)
    handles = [p for p in parameters if is_handle(header, p.type)]
    if call.returned and handles and is_handle(header, call.returned[0].type, 2):
        call.owner = handles[0].name
    if re.search(r"_(destroy|close)$", function.name) and len(handles) == 1:
        call.destroyed = handles[0].name
    if call.throws and not has_message:
        call.error_function, call.error_handle = _find_error_source(header, function)
    return call


def join_words(name):
    """Return a C name as one word of capitals: hearth_pack_info becomes PackInfo."""
    return "".join(word[:1].upper() + word[1:] for word in name.removeprefix("hearth_").split("_"))


def list_defaults(value):
    """Return the places of a default that are not zero, each as the numbers of fields and elements on the way
    to it, and its value: a number or "sizeof"."""
    if isinstance(value, list):
        places = []
        for index, element in enumerate(value):
            places += [((index,) + rest, leaf) for rest, leaf in list_defaults(element)]
        return places
    return [((), value)] if value else []


def name_place(header, struct, place):
    """Return the place of list_defaults as code: camera.up[1]. Also the type of its number."""
    text, c_type, dimensions = "", None, ()
    for index in place:
        if dimensions:
            text += f"[{index}]"
            dimensions = dimensions[1:]
            continue
        if c_type is not None:
            struct = header.structs[c_type.base]
        field = struct.fields[index]
        text += f".{field.name}"
        c_type, dimensions = field.type, field.dimensions
    return text[1:], c_type
