// Describes the layout of a record as data, so that FORMAT.md and the static checks are derived from the
// struct itself.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

namespace hearth
{

struct Field
{
    std::string_view name;
    std::string_view type;
    size_t offset;
    size_t size;
    std::string_view note;
};

template <typename T>
constexpr std::string_view fieldTypeName()
{
    if constexpr (std::is_same_v<T, uint8_t>)
        return "u8";
    else if constexpr (std::is_same_v<T, uint16_t>)
        return "u16";
    else if constexpr (std::is_same_v<T, uint32_t>)
        return "u32";
    else if constexpr (std::is_same_v<T, uint64_t>)
        return "u64";
    else if constexpr (std::is_same_v<T, float>)
        return "f32";
    else if constexpr (std::is_same_v<T, Float2>)
        return "f32[2]";
    else if constexpr (std::is_same_v<T, Float3>)
        return "f32[3]";
    else if constexpr (std::is_same_v<T, Float4>)
        return "f32[4]";
    else if constexpr (std::is_same_v<T, Affine3>)
        return "f32[3][4]";
    else if constexpr (std::is_array_v<T> && std::is_same_v<std::remove_extent_t<T>, uint8_t>)
        return "u8[]";
    else if constexpr (std::is_array_v<T> && std::is_same_v<std::remove_extent_t<T>, uint16_t>)
        return "u16[]";
    else if constexpr (std::is_array_v<T> && std::is_same_v<std::remove_extent_t<T>, uint32_t>)
        return "u32[]";
    else if constexpr (std::is_array_v<T> && std::is_same_v<std::remove_extent_t<T>, int32_t>)
        return "i32[]";
    else if constexpr (std::is_array_v<T> && std::is_same_v<std::remove_extent_t<T>, float>)
        return "f32[]";
    else
        return T::kTypeName;
}

/// Return a name without its namespaces.
constexpr std::string_view unqualifiedName(std::string_view name)
{
    return name.substr(name.rfind(':') + 1);
}

/// Name and fields of a record. HEARTH_RECORD specialises it for every record.
template <typename T>
struct RecordFields;

/// True if the fields follow each other without a gap and fill the whole struct: no hidden padding in a file.
template <size_t N>
constexpr bool hasNoGaps(const std::array<Field, N>& fields, size_t size)
{
    size_t at = 0;
    for (const Field& field : fields)
    {
        if (field.offset != at)
            return false;
        at += field.size;
    }
    return at == size;
}

/// Layout of a record, for tables of several records.
struct RecordInfo
{
    std::string_view name{}; ///< empty: no record
    size_t size = 0;         ///< bytes
    std::span<const Field> fields{};
};

template <typename T>
constexpr RecordInfo recordInfo()
{
    return {RecordFields<T>::name, sizeof(T), RecordFields<T>::value};
}

} // namespace hearth

#define HEARTH_FIELD(record, member, note)                                                                   \
    ::hearth::Field                                                                                          \
    {                                                                                                        \
        #member, ::hearth::fieldTypeName<decltype(record::member)>(), offsetof(record, member),              \
            sizeof(record::member), note                                                                     \
    }

/// Define RecordFields of a record. Use at global scope, after the struct: HEARTH_RECORD(hearth::X, size,
/// HEARTH_FIELD(...), ...).
#define HEARTH_RECORD(record, byte_size, ...)                                                                \
    template <>                                                                                              \
    struct hearth::RecordFields<record>                                                                      \
    {                                                                                                        \
        static constexpr std::string_view name = hearth::unqualifiedName(#record);                           \
        static constexpr std::array value{__VA_ARGS__};                                                      \
    };                                                                                                       \
    static_assert(sizeof(record) == (byte_size) && std::is_trivially_copyable_v<record>);                    \
    static_assert(hearth::hasNoGaps(hearth::RecordFields<record>::value, sizeof(record)))
