// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"

#include "cook/json/json_events.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ostream>

#include <nlohmann/json.hpp>

namespace hearth
{

namespace
{

constexpr size_t kMaxDepth = 1000;

const char* typeName(const Json& json)
{
    return json.is_null()      ? "null"
           : json.is_boolean() ? "a boolean"
           : json.is_number()  ? "a number"
           : json.is_string()  ? "a string"
           : json.is_array()   ? "an array"
                               : "an object";
}

[[noreturn]] void throwWrongType(const Json& json, const char* wanted)
{
    throw JsonError(std::string("a value is ") + typeName(json) + " and must be " + wanted);
}

[[noreturn]] void throwMissing(std::string_view key)
{
    throw JsonError("member '" + std::string(key) + "' is missing");
}

[[noreturn]] void throwMissing(size_t index)
{
    throw JsonError("element " + std::to_string(index) + " is missing");
}

// ---- reading

/// Adapter from the library's SAX parser to JsonEvents.
class SaxAdapter
{
public:
    explicit SaxAdapter(JsonEvents& events) : events_(events) {}

    const std::optional<size_t>& fault() const { return fault_; }

    bool null() { return events_.null(); }
    bool boolean(bool value) { return events_.boolean(value); }
    bool number_integer(int64_t value) { return events_.integer(value); }
    bool number_unsigned(uint64_t value) { return events_.unsignedInteger(value); }
    bool number_float(double value, const std::string&) { return events_.number(value); }
    bool string(std::string& text) { return events_.string(text); }
    bool binary(nlohmann::json::binary_t&) { return false; }
    bool start_object(size_t) { return events_.beginObject(); }
    bool key(std::string& text) { return events_.key(text); }
    bool end_object() { return events_.endObject(); }
    bool start_array(size_t) { return events_.beginArray(); }
    bool end_array() { return events_.endArray(); }
    bool parse_error(size_t position, const std::string&, const nlohmann::json::exception&)
    {
        fault_ = position;
        return false;
    }

private:
    JsonEvents& events_;
    std::optional<size_t> fault_;
};

/// Builder of a Json value from the parser's events.
class Builder final : public JsonEvents
{
public:
    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool integer(int64_t value) override { return add(value); }
    bool unsignedInteger(uint64_t value) override { return add(value); }
    bool number(double value) override { return add(value); }
    bool string(std::string& text) override { return add(std::move(text)); }
    bool beginArray() override { return open(Json::array()); }
    bool endArray() override { return close(); }
    bool beginObject() override { return open(Json::object()); }
    bool endObject() override { return close(); }
    bool key(std::string& text) override
    {
        key_ = std::move(text);
        return true;
    }

    bool isComplete() const { return has_root_ && open_.empty(); }
    Json take() { return std::move(root_); }

private:
    bool add(Json value)
    {
        place(std::move(value));
        return true;
    }

    bool open(Json container)
    {
        if (open_.size() == kMaxDepth)
            return false;
        open_.push_back(&place(std::move(container)));
        return true;
    }

    bool close()
    {
        open_.pop_back();
        return true;
    }

    /// Add the value to the open container and return its place, which is valid until that container is
    /// closed.
    Json& place(Json value)
    {
        has_root_ = true;
        if (open_.empty())
            return root_ = std::move(value);
        Json& container = *open_.back();
        if (container.is_object())
            return container[key_] = std::move(value);
        container.push_back(std::move(value));
        return container.back();
    }

    Json root_;
    std::vector<Json*> open_;
    std::string key_;
    bool has_root_ = false;
};

/// Return the array index of a step of a JSON pointer; nullopt if the step is no index.
std::optional<size_t> parseIndex(std::string_view step)
{
    size_t index = 0;
    const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
    return error == std::errc() && end == step.data() + step.size() ? std::optional(index) : std::nullopt;
}

/// Return the object key of a step of a JSON pointer.
std::string unescapeKey(std::string_view step)
{
    std::string key;
    for (size_t i = 0; i < step.size(); ++i)
    {
        const bool is_escape = step[i] == '~' && i + 1 < step.size();
        key += !is_escape ? step[i] : step[++i] == '1' ? '/' : '~';
    }
    return key;
}

} // namespace

// ---- construction

Json::Json() noexcept = default;
Json::Json(const Json& other) = default;
Json::Json(Json&& other) noexcept : content_(std::exchange(other.content_, std::monostate())) {}
Json& Json::operator=(const Json& other)
{
    Json copy(other); // `other` may be a part of this value
    content_.swap(copy.content_);
    return *this;
}
Json& Json::operator=(Json&& other) noexcept
{
    Json taken(std::move(other));
    content_.swap(taken.content_);
    return *this;
}
Json::~Json() = default;

Json::Json(std::nullptr_t) noexcept {}
Json::Json(std::string text) : content_(std::move(text)) {}
Json::Json(std::string_view text) : content_(std::string(text)) {}
Json::Json(const char* text) : content_(std::string(text)) {}

Json::Json(std::initializer_list<Item> items)
{
    const bool is_object =
        std::all_of(items.begin(), items.end(),
                    [](const Item& item)
                    {
                        const Json& pair = item.peek();
                        return pair.is_array() && pair.size() == 2 && pair.at(size_t{0}).is_string();
                    });
    if (!is_object)
    {
        *this = array(items);
        return;
    }
    *this = object();
    for (const Item& item : items)
    {
        Json pair = item.take();
        (*this)[pair.at(size_t{0}).text()] = std::move(pair.at(size_t{1}));
    }
}

Json Json::array()
{
    Json json;
    json.content_.emplace<Array>();
    return json;
}

Json Json::array(std::initializer_list<Item> items)
{
    Json json = array();
    Array& elements = json.elements();
    elements.reserve(items.size());
    for (const Item& item : items)
        elements.push_back(item.take());
    return json;
}

Json Json::object()
{
    Json json;
    json.content_.emplace<Object>();
    return json;
}

void Json::setBoolean(bool value)
{
    content_ = value;
}

void Json::setInteger(int64_t value)
{
    content_ = value;
}

void Json::setUnsigned(uint64_t value)
{
    content_ = value;
}

void Json::setNumber(double value)
{
    content_ = value;
}

// ---- access

bool Json::is_null() const
{
    return std::holds_alternative<std::monostate>(content_);
}

bool Json::is_boolean() const
{
    return std::holds_alternative<bool>(content_);
}

bool Json::is_number() const
{
    return is_number_integer() || std::holds_alternative<double>(content_);
}

bool Json::is_number_integer() const
{
    return std::holds_alternative<int64_t>(content_) || is_number_unsigned();
}

bool Json::is_number_unsigned() const
{
    return std::holds_alternative<uint64_t>(content_);
}

bool Json::is_string() const
{
    return std::holds_alternative<std::string>(content_);
}

bool Json::is_array() const
{
    return std::holds_alternative<Array>(content_);
}

bool Json::is_object() const
{
    return std::holds_alternative<Object>(content_);
}

size_t Json::size() const
{
    return is_array() ? elements().size() : is_object() ? members().size() : 0;
}

const Json::Array& Json::elements() const
{
    if (const Array* array = std::get_if<Array>(&content_))
        return *array;
    throwWrongType(*this, "an array");
}

Json::Array& Json::elements()
{
    return const_cast<Array&>(std::as_const(*this).elements());
}

const Json::Object& Json::members() const
{
    if (const Object* object = std::get_if<Object>(&content_))
        return *object;
    throwWrongType(*this, "an object");
}

bool Json::boolean() const
{
    if (const bool* flag = std::get_if<bool>(&content_))
        return *flag;
    throwWrongType(*this, "a boolean");
}

uint64_t Json::integerBits() const
{
    if (const uint64_t* count = std::get_if<uint64_t>(&content_))
        return *count;
    if (const int64_t* integer = std::get_if<int64_t>(&content_))
        return static_cast<uint64_t>(*integer);
    const double value = number();
    constexpr double kEndOfSigned = 0x1p63, kEndOfUnsigned = 0x1p64;
    if (value >= 0 && value < kEndOfUnsigned)
        return static_cast<uint64_t>(value);
    if (value >= -kEndOfSigned && value < 0)
        return static_cast<uint64_t>(static_cast<int64_t>(value));
    throw JsonError("a number is out of range");
}

double Json::number() const
{
    if (const double* number = std::get_if<double>(&content_))
        return *number;
    if (const uint64_t* count = std::get_if<uint64_t>(&content_))
        return static_cast<double>(*count);
    if (const int64_t* integer = std::get_if<int64_t>(&content_))
        return static_cast<double>(*integer);
    throwWrongType(*this, "a number");
}

const std::string& Json::text() const
{
    if (const std::string* text = std::get_if<std::string>(&content_))
        return *text;
    throwWrongType(*this, "a string");
}

const Json* Json::begin() const
{
    return is_null() ? nullptr : elements().data();
}

const Json* Json::end() const
{
    return is_null() ? nullptr : elements().data() + elements().size();
}

Json* Json::begin()
{
    return const_cast<Json*>(std::as_const(*this).begin());
}

Json* Json::end()
{
    return const_cast<Json*>(std::as_const(*this).end());
}

std::span<const Json::Member> Json::items() const
{
    return is_null() ? std::span<const Member>() : std::span<const Member>(members());
}

const Json& Json::at(size_t index) const
{
    const Array& array = elements();
    if (index >= array.size())
        throwMissing(index);
    return array[index];
}

const Json& Json::at(std::string_view key) const
{
    if (const Json* member = findMember(key))
        return *member;
    throwMissing(key);
}

Json& Json::at(size_t index)
{
    return const_cast<Json&>(std::as_const(*this).at(index));
}

Json& Json::operator[](std::string_view key)
{
    if (is_null())
        *this = object();
    if (const Json* member = findMember(key))
        return const_cast<Json&>(*member);
    addMember(key, Json());
    return std::get<Object>(content_).back().value;
}

const Json* Json::findMember(std::string_view key) const
{
    const Object& object = members();
    const auto found =
        std::find_if(object.begin(), object.end(), [&](const Member& member) { return member.key == key; });
    return found == object.end() ? nullptr : &found->value;
}

const Json* Json::find(std::string_view key) const
{
    return is_object() ? findMember(key) : nullptr;
}

const Json* Json::resolve(std::string_view pointer) const
{
    const Json* at = this;
    while (!pointer.empty() && at != nullptr)
    {
        if (pointer.front() != '/')
            return nullptr;
        const size_t end = std::min(pointer.find('/', 1), pointer.size());
        const std::string_view step = pointer.substr(1, end - 1);
        pointer.remove_prefix(end);
        const std::optional<size_t> index = at->is_array() ? parseIndex(step) : std::nullopt;
        at = !at->is_array()                ? at->find(unescapeKey(step))
             : index && *index < at->size() ? &at->at(*index)
                                            : nullptr;
    }
    return at;
}

const Json& Json::back() const
{
    return at(size() - 1);
}

Json& Json::back()
{
    return at(size() - 1);
}

std::string Json::value(std::string_view key, const char* fallback) const
{
    return value(key, std::string(fallback));
}

// ---- modification

void Json::addMember(std::string_view key, Json value)
{
    std::get<Object>(content_).push_back({std::string(key), std::move(value)});
}

void Json::push_back(Json value)
{
    if (is_null())
        *this = array();
    elements().push_back(std::move(value));
}

void Json::update(const Json& other)
{
    if (is_null())
        *this = object();
    members(); // throws if this is no object
    for (const Member& member : other.members())
        (*this)[member.key] = member.value;
}

void Json::erase(std::string_view key)
{
    members(); // throws if this is no object
    std::erase_if(std::get<Object>(content_), [&](const Member& member) { return member.key == key; });
}

void Json::erase(size_t index)
{
    at(index); // throws if there is no such element
    elements().erase(elements().begin() + static_cast<std::ptrdiff_t>(index));
}

bool operator==(const Json& a, const Json& b)
{
    const auto isNegative = [](const Json& json)
    {
        const int64_t* integer = std::get_if<int64_t>(&json.content_);
        return integer != nullptr && *integer < 0;
    };
    const auto hasEqual = [&](const Json::Member& member)
    {
        const Json* other = b.find(member.key);
        return other != nullptr && member.value == *other;
    };
    if (a.is_number_integer() && b.is_number_integer())
        return isNegative(a) == isNegative(b) && a.integerBits() == b.integerBits();
    if (a.is_number() && b.is_number())
        return a.number() == b.number();
    if (a.is_object() && b.is_object())
        return a.size() == b.size() && std::all_of(a.members().begin(), a.members().end(), hasEqual);
    if (a.is_array() && b.is_array())
        return a.elements() == b.elements();
    if (a.is_string() && b.is_string())
        return a.text() == b.text();
    if (a.is_boolean() && b.is_boolean())
        return a.boolean() == b.boolean();
    return a.is_null() && b.is_null();
}

// ---- text

std::optional<size_t> parseJson(std::string_view text, JsonEvents& events)
{
    SaxAdapter target(events);
    nlohmann::json::sax_parse(text.begin(), text.end(), &target);
    return target.fault();
}

std::optional<Json> Json::parse(std::string_view text)
{
    Builder builder;
    if (parseJson(text, builder) || !builder.isComplete())
        return std::nullopt;
    return builder.take();
}

class Json::Writer
{
public:
    Writer(int indent, char fill)
        : step_(indent < 0 ? 0 : static_cast<size_t>(indent)), fill_(fill), breaks_(indent >= 0)
    {
    }

    void write(const Json& json)
    {
        if (json.is_array())
            writeContainer('[', json, ']', [&](const Json& element) { write(element); });
        else if (json.is_object())
            writeContainer('{', json.items(), '}', [&](const Member& member) { writeMember(member); });
        else
            writeScalar(json);
    }

    std::string take() { return std::move(text_); }

private:
    template <typename List, typename Write>
    void writeContainer(char open, const List& list, char close, Write writeOne)
    {
        text_ += open;
        ++depth_;
        bool is_first = true;
        for (const auto& one : list)
        {
            if (!is_first)
                text_ += ',';
            is_first = false;
            breakLine();
            writeOne(one);
        }
        --depth_;
        if (!is_first)
            breakLine();
        text_ += close;
    }

    void writeMember(const Member& member)
    {
        text_ += quoteJson(member.key);
        text_ += breaks_ ? ": " : ":";
        write(member.value);
    }

    void writeScalar(const Json& json)
    {
        if (json.is_null())
            text_ += "null";
        else if (json.is_boolean())
            text_ += json.boolean() ? "true" : "false";
        else if (const int64_t* integer = std::get_if<int64_t>(&json.content_))
            text_ += std::to_string(*integer);
        else if (json.is_number_unsigned())
            text_ += std::to_string(json.integerBits());
        else if (json.is_number())
            writeNumber(json.number());
        else
            text_ += quoteJson(json.text());
    }

    void writeNumber(double number)
    {
        std::array<char, 64> digits{};
        if (std::isfinite(number))
            text_.append(digits.data(),
                         nlohmann::detail::to_chars(digits.data(), digits.data() + digits.size(), number));
        else
            text_ += "null";
    }

    void breakLine()
    {
        if (!breaks_)
            return;
        text_ += '\n';
        text_.append(depth_ * step_, fill_);
    }

    std::string text_;
    size_t depth_ = 0;
    size_t step_;
    char fill_;
    bool breaks_;
};

std::string Json::dump(int indent, char fill) const
{
    Writer writer(indent, fill);
    writer.write(*this);
    return writer.take();
}

std::ostream& operator<<(std::ostream& stream, const Json& json)
{
    return stream << json.dump();
}

std::string quoteJson(std::string_view text)
{
    const bool is_plain = std::all_of(text.begin(), text.end(),
                                      [](char c) { return c >= ' ' && c < '\x7F' && c != '"' && c != '\\'; });
    if (is_plain)
        return '"' + std::string(text) + '"';
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string pointerStep(std::string_view key)
{
    std::string step = "/";
    for (const char c : key)
        if (c == '~' || c == '/')
            step += c == '~' ? "~0" : "~1";
        else
            step += c;
    return step;
}

} // namespace hearth
