// JSON value with its parser and writer. Only json.cpp includes the JSON library (nlohmann's); all other
// files use this class, whose functions have the names of that library's functions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iosfwd>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace hearth
{

/// Error for a value that is absent, or has another type than requested. what() names the member or the
/// types.
class JsonError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

/// Container that becomes an array, or an object if it maps strings to values.
template <typename T>
concept JsonContainer = !std::convertible_to<const T&, std::string_view> && !std::same_as<T, class Json> &&
                        requires(const T& list) {
                            list.begin();
                            list.end();
                            list.size();
                        };

/// JSON value: null, boolean, number, string, array, or object whose members keep the order of their
/// insertion. Numbers are signed integers, unsigned integers or doubles, and are written as such: Json(1) as
/// 1, Json(1.0) as 1.0.
class Json
{
public:
    struct Member;
    class Item; ///< element of an initializer list: anything convertible to Json

    Json() noexcept;
    Json(const Json& other);
    Json(Json&& other) noexcept; ///< leaves `other` null
    Json& operator=(const Json& other);
    Json& operator=(Json&& other) noexcept;
    ~Json();

    Json(std::nullptr_t) noexcept;
    Json(std::string text);
    Json(std::string_view text);
    Json(const char* text);
    template <std::integral T>
    Json(T value)
    {
        if constexpr (std::same_as<T, bool>)
            setBoolean(value);
        else if constexpr (std::is_signed_v<T>)
            setInteger(value);
        else
            setUnsigned(value);
    }
    template <std::floating_point T>
    Json(T value)
    {
        setNumber(static_cast<double>(value));
    }
    template <JsonContainer T>
    Json(const T& list)
    {
        if constexpr (requires { typename T::mapped_type; })
        {
            *this = object();
            for (const auto& [key, value] : list)
                addMember(key, Json(value));
        }
        else
        {
            *this = array();
            for (const auto& value : list)
                push_back(Json(value));
        }
    }
    /// Make an object if each item is an array of two whose first element is a string; else an array.
    Json(std::initializer_list<Item> items);

    static Json array();
    static Json array(std::initializer_list<Item> items);
    static Json object();

    /// Parse JSON text (RFC 8259, UTF-8); nullopt if it is invalid or nested more than 1000 levels deep. Of
    /// members with equal keys the last one counts.
    static std::optional<Json> parse(std::string_view text);

    /// Write on one line, or with `indent` times `fill` for each level. Bytes that are not UTF-8 become
    /// U+FFFD, numbers that are not finite become null.
    std::string dump(int indent = -1, char fill = ' ') const;

    bool is_null() const;
    bool is_boolean() const;
    bool is_number() const;
    bool is_number_integer() const;  ///< integer, signed or unsigned
    bool is_number_unsigned() const; ///< unsigned integer, as every parsed non-negative integer
    bool is_string() const;
    bool is_array() const;
    bool is_object() const;

    /// Number of elements of an array or members of an object, else 0.
    size_t size() const;
    bool empty() const { return size() == 0; }

    /// Elements of an array; none for null. Throws JsonError for all else.
    const Json* begin() const;
    const Json* end() const;
    Json* begin();
    Json* end();
    /// Members of an object; none for null. Throws JsonError for all else.
    std::span<const Member> items() const;

    /// Element or member; throws JsonError if there is none.
    const Json& at(size_t index) const;
    const Json& at(std::string_view key) const;
    Json& at(size_t index);
    const Json& operator[](size_t index) const { return at(index); }
    const Json& operator[](std::string_view key) const { return at(key); }
    Json& operator[](size_t index) { return at(index); }
    /// Return the member, after adding a null one if it is absent; null becomes an object. Throws JsonError
    /// for all else.
    Json& operator[](std::string_view key);

    /// Return the member; null pointer if it is absent, or this is no object.
    const Json* find(std::string_view key) const;
    bool contains(std::string_view key) const { return find(key) != nullptr; }
    /// Return the value at a JSON pointer (RFC 6901), as "/meshes/0/name"; null pointer if there is none.
    const Json* resolve(std::string_view pointer) const;

    const Json& back() const; ///< last element; throws JsonError if there is none
    Json& back();
    /// Append an element; null becomes an array. Throws JsonError for all else.
    void push_back(Json value);
    /// Set all members of `other` here; null becomes an object. Throws JsonError if one of the two is no
    /// object.
    void update(const Json& other);
    void erase(std::string_view key); ///< does nothing if there is no such member
    void erase(size_t index);         ///< throws JsonError if there is no such element

    /// Convert the value to a boolean, number, string, container of such, or Json. Throws JsonError if it has
    /// another type, or if an integer is requested and the double is out of the range of 64 bits. Integers
    /// are converted as by a cast.
    template <typename T>
    T get() const;
    template <typename T>
    void get_to(T& value) const
    {
        value = get<T>();
    }
    /// Return the member as get() converts it, or `fallback` if it is absent. Throws JsonError as get()
    /// does, and if this is no object.
    template <typename T>
    T value(std::string_view key, T fallback) const;
    std::string value(std::string_view key, const char* fallback) const;

    /// Compare numbers by value, and objects regardless of the order of their members.
    friend bool operator==(const Json& a, const Json& b);

private:
    class Writer;
    using Array = std::vector<Json>;
    using Object = std::vector<Member>;

    void setBoolean(bool value);
    void setInteger(int64_t value);
    void setUnsigned(uint64_t value);
    void setNumber(double value);
    void addMember(std::string_view key, Json value); ///< precondition: the key is new
    const Json* findMember(std::string_view key) const;
    const Array& elements() const;
    Array& elements();
    const Object& members() const;
    bool boolean() const;
    uint64_t integerBits() const; ///< integer of 64 bits, a negative one as cast to unsigned
    double number() const;
    const std::string& text() const;

    std::variant<std::monostate, bool, int64_t, uint64_t, double, std::string, Array, Object> content_;
};

struct Json::Member
{
    std::string key;
    Json value;
};

class Json::Item
{
public:
    Item(std::initializer_list<Item> items) : value_(items) {}
    template <typename T>
        requires(!std::same_as<std::remove_cvref_t<T>, Json::Item> && std::convertible_to<T, Json>)
    Item(T&& value) : value_(std::forward<T>(value)) // NOLINT(bugprone-forwarding-reference-overload)
    {
    }

    const Json& peek() const { return value_; }
    /// Move the value out, although elements of an initializer list are const. Otherwise each level of a
    /// document would copy all values below it.
    Json take() const { return std::move(value_); }

private:
    mutable Json value_;
};

template <typename T>
T Json::get() const
{
    if constexpr (std::same_as<T, Json>)
        return *this;
    else if constexpr (std::same_as<T, bool>)
        return boolean();
    else if constexpr (std::integral<T>)
        return static_cast<T>(integerBits());
    else if constexpr (std::floating_point<T>)
        return static_cast<T>(number());
    else if constexpr (std::same_as<T, std::string>)
        return text();
    else if constexpr (requires { typename T::mapped_type; })
    {
        T map;
        for (const Member& member : members())
            map[member.key] = member.value.get<typename T::mapped_type>();
        return map;
    }
    else
    {
        T list;
        for (const Json& element : elements())
            list.push_back(element.get<typename T::value_type>());
        return list;
    }
}

template <typename T>
T Json::value(std::string_view key, T fallback) const
{
    const Json* member = findMember(key);
    return member == nullptr ? std::move(fallback) : member->get<T>();
}

/// Write the value as dump() does.
std::ostream& operator<<(std::ostream& stream, const Json& json);

/// Return `text` as a JSON string with its quotes; bytes that are not UTF-8 become U+FFFD.
std::string quoteJson(std::string_view text);

/// Return the step of a JSON pointer to a member: "/" and the key, with "~" and "/" escaped as "~0" and "~1".
std::string pointerStep(std::string_view key);

} // namespace hearth
