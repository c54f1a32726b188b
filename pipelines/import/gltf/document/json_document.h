// Parses a JSON text into a flat table of values that know their JSON pointer, for messages.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::import
{

enum class JsonType : uint8_t
{
    null,
    boolean,
    number,
    string,
    array,
    object,
};

/// Return the name of a type for messages: "a string", "an object".
std::string_view jsonTypeName(JsonType type);

class JsonDocument;

/// One value of a document, valid as long as the document is not moved or destroyed. Cheap to copy.
class Json
{
public:
    Json(const JsonDocument& document, uint32_t value) : document_(&document), value_(value) {}

    JsonType type() const;
    bool isObject() const { return type() == JsonType::object; }
    bool isArray() const { return type() == JsonType::array; }
    bool isString() const { return type() == JsonType::string; }
    bool isNumber() const { return type() == JsonType::number; }

    bool boolean() const;            ///< of a boolean (asserted)
    double number() const;           ///< of a number (asserted)
    std::string_view string() const; ///< of a string (asserted)

    size_t size() const;             ///< elements of an array or members of an object, else 0
    Json operator[](size_t i) const; ///< element or member i < size() (asserted)
    std::string_view key() const;    ///< name of this member; empty if this is no member
    std::optional<Json> find(std::string_view name) const; ///< member of an object; the last of equal names

    /// Return the JSON pointer (RFC 6901): "/meshes/0/primitives/1"; empty for the whole document.
    std::string pointer() const;

    /// Return the number of this value in the order of the text; the root is 0.
    uint32_t position() const { return value_; }

private:
    const JsonDocument* document_;
    uint32_t value_;
};

class JsonDocument
{
public:
    /// Parse strictly (RFC 8259, UTF-8), except that equal names in an object are tolerated.
    /// `file` is used in messages. errors: json_syntax (also for more than 128 levels), input_too_large.
    static Result<JsonDocument> parse(std::string_view text, const std::string& file);

    Json root() const { return {*this, 0}; }

private:
    friend class Json;
    friend class JsonBuilder;

    struct Text
    {
        uint32_t offset = 0;
        uint32_t length = 0;
    };

    /// Value of the table. `content` is the number, or for a string its Text, or for a container a range of
    /// children_.
    struct Value
    {
        JsonType type = JsonType::null;
        bool boolean = false;
        uint32_t parent = 0;
        Text key;
        Text content;
        double number = 0;
    };

    std::string_view text(Text part) const
    {
        return std::string_view(text_).substr(part.offset, part.length);
    }

    std::vector<Value> values_;      ///< in the order of the text; the root is first
    std::vector<uint32_t> children_; ///< the values of each container, one container after the other
    std::string text_;               ///< all keys and strings
};

} // namespace hearth::import
