// Number parsing for options and small files.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

namespace hearth::viewer
{

/// Parse the whole text as a finite number.
template <typename T>
std::optional<T> parseNumber(std::string_view text)
{
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    if constexpr (std::is_floating_point_v<T>)
        if (!std::isfinite(value))
            return std::nullopt;
    return value;
}

/// Parse finite numbers between commas.
inline std::optional<std::vector<float>> parseNumbers(std::string_view text)
{
    std::vector<float> numbers;
    for (size_t at = 0; at <= text.size();)
    {
        const size_t end = std::min(text.find(',', at), text.size());
        const auto number = parseNumber<float>(text.substr(at, end - at));
        if (!number)
            return std::nullopt;
        numbers.push_back(*number);
        at = end + 1;
    }
    return numbers;
}

} // namespace hearth::viewer
