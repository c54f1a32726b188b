// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/json_document.h"

#include "cook/json/json.h"
#include "cook/json/json_events.h"

#include <algorithm>

namespace hearth::import
{

namespace
{

// glTF itself needs about 10 levels; the rest is for extras
constexpr size_t kMaxDepth = 128;

// Limit of values: each takes at least two bytes of text and 44 here; 2^24 values (a scene of a million
// nodes) are 0.7 GB at most.
constexpr size_t kMaxValues = size_t{1} << 24;
constexpr size_t kMaxTextBytes = size_t{1} << 30;

} // namespace

/// Receives the parser's events and builds the document.
class JsonBuilder final : public JsonEvents
{
public:
    JsonBuilder(JsonDocument& document, std::string_view source, const std::string& file)
        : document_(document), source_(source), file_(file)
    {
    }

    const std::optional<Error>& error() const { return error_; }

    bool null() override { return add(JsonType::null); }
    bool boolean(bool value) override
    {
        return add(JsonType::boolean, [&](JsonDocument::Value& v) { v.boolean = value; });
    }
    bool integer(int64_t value) override { return number(static_cast<double>(value)); }
    bool unsignedInteger(uint64_t value) override { return number(static_cast<double>(value)); }
    bool number(double value) override
    {
        return add(JsonType::number, [&](JsonDocument::Value& v) { v.number = value; });
    }
    bool string(std::string& value) override
    {
        const JsonDocument::Text stored = store(value);
        return add(JsonType::string, [&](JsonDocument::Value& v) { v.content = stored; });
    }
    bool beginObject() override { return open(JsonType::object); }
    bool beginArray() override { return open(JsonType::array); }
    bool endObject() override { return close(); }
    bool endArray() override { return close(); }
    bool key(std::string& name) override
    {
        key_ = store(name);
        return true;
    }

    /// Return the error for a text that is not JSON.
    /// position  number of bytes read when the parser failed
    Error syntaxError(size_t position) const
    {
        const size_t at = std::min(position, source_.size());
        const std::string_view before = source_.substr(0, at == 0 ? 0 : at - 1);
        const auto line = std::count(before.begin(), before.end(), '\n') + 1;
        const size_t line_start = before.rfind('\n') + 1; // npos + 1 is 0
        const bool ended = position >= source_.size();
        return {Issue::json_syntax, file_, "line " + std::to_string(line),
                ended ? "the JSON text ends too early"
                      : "not JSON at column " + std::to_string(before.size() - line_start + 1)};
    }

private:
    struct OpenContainer
    {
        uint32_t value;
        size_t first_pending;
    };

    bool fail(Issue issue, std::string where, std::string detail)
    {
        error_ = Error{issue, file_, std::move(where), std::move(detail)};
        return false;
    }

    JsonDocument::Text store(const std::string& text)
    {
        const auto offset = static_cast<uint32_t>(document_.text_.size());
        document_.text_ += text;
        return {offset, static_cast<uint32_t>(text.size())};
    }

    bool add(JsonType type)
    {
        return add(type, [](JsonDocument::Value&) {});
    }

    template <typename Fill>
    bool add(JsonType type, Fill fill)
    {
        if (document_.values_.size() >= kMaxValues)
            return fail(Issue::input_too_large, "",
                        "the JSON text has more than " + std::to_string(kMaxValues) + " values");
        const auto index = static_cast<uint32_t>(document_.values_.size());
        JsonDocument::Value& value = document_.values_.emplace_back();
        value.type = type;
        value.parent = open_.empty() ? 0 : open_.back().value;
        value.key = key_;
        key_ = {};
        fill(value);
        pending_.push_back(index);
        return true;
    }

    bool open(JsonType type)
    {
        if (open_.size() >= kMaxDepth)
            return fail(Issue::json_syntax, "",
                        "the JSON text is nested more than " + std::to_string(kMaxDepth) + " levels deep");
        if (!add(type))
            return false;
        open_.push_back({pending_.back(), pending_.size()});
        return true;
    }

    bool close()
    {
        const OpenContainer container = open_.back();
        open_.pop_back();
        const auto first = pending_.begin() + static_cast<std::ptrdiff_t>(container.first_pending);
        JsonDocument::Value& value = document_.values_[container.value];
        value.content = {static_cast<uint32_t>(document_.children_.size()),
                         static_cast<uint32_t>(pending_.end() - first)};
        document_.children_.insert(document_.children_.end(), first, pending_.end());
        pending_.erase(first, pending_.end());
        return true;
    }

    JsonDocument& document_;
    std::string_view source_;
    const std::string& file_;
    JsonDocument::Text key_;
    std::vector<OpenContainer> open_;
    std::vector<uint32_t> pending_; ///< known children of the open containers
    std::optional<Error> error_;
};

Result<JsonDocument> JsonDocument::parse(std::string_view text, const std::string& file)
{
    if (text.size() > kMaxTextBytes)
        return Error{Issue::input_too_large, file, "",
                     "the JSON text has " + std::to_string(text.size()) + " bytes, at most " +
                         std::to_string(kMaxTextBytes) + " are read"};
    if (text.starts_with("\xEF\xBB\xBF"))
        return Error{Issue::json_syntax, file, "", "the JSON text starts with a byte-order mark"};
    JsonDocument document;
    JsonBuilder builder(document, text, file);
    if (const std::optional<size_t> fault = parseJson(text, builder))
        return builder.syntaxError(*fault);
    if (builder.error())
        return *builder.error();
    return document;
}

std::string_view jsonTypeName(JsonType type)
{
    switch (type)
    {
    case JsonType::null:
        return "null";
    case JsonType::boolean:
        return "a boolean";
    case JsonType::number:
        return "a number";
    case JsonType::string:
        return "a string";
    case JsonType::array:
        return "an array";
    case JsonType::object:
        return "an object";
    }
    return "";
}

JsonType Json::type() const
{
    return document_->values_[value_].type;
}

bool Json::boolean() const
{
    HEARTH_ASSERT(type() == JsonType::boolean);
    return document_->values_[value_].boolean;
}

double Json::number() const
{
    HEARTH_ASSERT(isNumber());
    return document_->values_[value_].number;
}

std::string_view Json::string() const
{
    HEARTH_ASSERT(isString());
    return document_->text(document_->values_[value_].content);
}

size_t Json::size() const
{
    return isArray() || isObject() ? document_->values_[value_].content.length : 0;
}

Json Json::operator[](size_t i) const
{
    HEARTH_ASSERT(i < size());
    return {*document_, document_->children_[document_->values_[value_].content.offset + i]};
}

std::string_view Json::key() const
{
    return document_->text(document_->values_[value_].key);
}

std::optional<Json> Json::find(std::string_view name) const
{
    if (!isObject())
        return std::nullopt;
    for (size_t i = size(); i-- > 0;)
        if ((*this)[i].key() == name)
            return (*this)[i];
    return std::nullopt;
}

std::string Json::pointer() const
{
    std::string path;
    for (uint32_t at = value_; at != 0;)
    {
        const Json parent{*document_, document_->values_[at].parent};
        size_t i = 0;
        while (parent[i].value_ != at)
            ++i;
        path.insert(0, parent.isArray() ? "/" + std::to_string(i) : pointerStep(parent[i].key()));
        at = parent.value_;
    }
    return path;
}

} // namespace hearth::import
