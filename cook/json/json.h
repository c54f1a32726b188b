// A JSON value, and how it is read and written. The one file that includes a library for JSON is json.cpp:
// all others build and read documents with this class, whose functions are called as those of that library,
// nlohmann's.
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

/// A value is not there, or is of another type than was asked for. what() names the member or the types.
class JsonError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

/// A container that becomes an array, or an object where it maps texts to values.
template <typename T>
concept JsonContainer = !std::convertible_to<const T&, std::string_view> && !std::same_as<T, class Json> &&
                        requires(const T& list) {
                            list.begin();
                            list.end();
                            list.size();
                        };

/// Null, a boolean, a number, a text, an array, or an object whose members keep the order in which they were
/// added. Numbers are whole with a sign, whole without one, or double, and are written as such: Json(1) as 1,
/// Json(1.0) as 1.0.
class Json
{
public:
    struct Member;
    class Item; ///< of an initializer list: anything that becomes a Json

    Json() noexcept;
    Json(const Json& other);
    Json(Json&& other) noexcept; ///< leaves null
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
    /// An object where each item is an array of two, the first of them a text; else an array.
    Json(std::initializer_list<Item> items);

    static Json array();
    static Json array(std::initializer_list<Item> items);
    static Json object();

    /// nullopt where the text is not JSON (RFC 8259, in UTF-8), or is nested more than 1000 levels deep. Of
    /// members with equal keys the last one counts.
    static std::optional<Json> parse(std::string_view text);

    /// On one line, or with `indent` times `fill` for each level. Bytes that are no UTF-8 become U+FFFD,
    /// numbers that are not finite become null.
    std::string dump(int indent = -1, char fill = ' ') const;

    bool is_null() const;
    bool is_boolean() const;
    bool is_number() const;
    bool is_number_integer() const;  ///< whole, with a sign or without
    bool is_number_unsigned() const; ///< as each whole number that is not negative and was parsed
    bool is_string() const;
    bool is_array() const;
    bool is_object() const;

    /// Elements of an array or members of an object, else 0.
    size_t size() const;
    bool empty() const { return size() == 0; }

    /// The elements of an array; none of null. Throws JsonError for all else.
    const Json* begin() const;
    const Json* end() const;
    Json* begin();
    Json* end();
    /// The members of an object; none of null. Throws JsonError for all else.
    std::span<const Member> items() const;

    /// Element or member; throws JsonError where there is none.
    const Json& at(size_t index) const;
    const Json& at(std::string_view key) const;
    Json& at(size_t index);
    const Json& operator[](size_t index) const { return at(index); }
    const Json& operator[](std::string_view key) const { return at(key); }
    Json& operator[](size_t index) { return at(index); }
    /// Adds a member that is null where there is none; null becomes an object. Throws JsonError for all else.
    Json& operator[](std::string_view key);

    /// The member; null pointer where there is none, or this is no object.
    const Json* find(std::string_view key) const;
    bool contains(std::string_view key) const { return find(key) != nullptr; }
    /// The value that a JSON pointer (RFC 6901) as "/meshes/0/name" leads to; null pointer where it leads
    /// nowhere.
    const Json* resolve(std::string_view pointer) const;

    const Json& back() const; ///< the last element; throws JsonError where there is none
    Json& back();
    /// Adds an element; null becomes an array. Throws JsonError for all else.
    void push_back(Json value);
    /// Sets all members of `other` here; null becomes an object. Throws JsonError where one of the two is
    /// none.
    void update(const Json& other);
    void erase(std::string_view key); ///< does nothing where there is no such member
    void erase(size_t index);         ///< throws JsonError where there is no such element

    /// The value as a boolean, number, text, container of such, or Json. Throws JsonError where it is of
    /// another type, or a double that a whole number is asked of is out of the range of 64 bits. Whole
    /// numbers are converted as by a cast.
    template <typename T>
    T get() const;
    template <typename T>
    void get_to(T& value) const
    {
        value = get<T>();
    }
    /// The member as get() has it, or `otherwise` where there is none. Throws JsonError as get(), and where
    /// this is no object.
    template <typename T>
    T value(std::string_view key, T otherwise) const;
    std::string value(std::string_view key, const char* otherwise) const;

    /// Numbers are equal by value, objects whatever the order of their members.
    friend bool operator==(const Json& a, const Json& b);

private:
    class Writer;
    using Array = std::vector<Json>;
    using Object = std::vector<Member>;

    void setBoolean(bool value);
    void setInteger(int64_t value);
    void setUnsigned(uint64_t value);
    void setNumber(double value);
    void addMember(std::string_view key, Json value); ///< the key is new
    const Json* memberOrNull(std::string_view key) const;
    const Array& elements() const;
    Array& elements();
    const Object& members() const;
    bool boolean() const;
    uint64_t wholeBits() const; ///< of a negative number as by a cast
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
    /// The elements of an initializer list are const: what is in it would be copied at each level of a
    /// document.
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
        return static_cast<T>(wholeBits());
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
T Json::value(std::string_view key, T otherwise) const
{
    const Json* member = memberOrNull(key);
    return member == nullptr ? std::move(otherwise) : member->get<T>();
}

/// Writes the value as dump() has it.
std::ostream& operator<<(std::ostream& stream, const Json& json);

/// `text` as a JSON string with its quotes; bytes that are no UTF-8 become U+FFFD.
std::string quoteJson(std::string_view text);

/// The step of a JSON pointer that leads to a member: "/" and the key, with "~" and "/" written as "~0" and
/// "~1".
std::string pointerStep(std::string_view key);

} // namespace hearth
