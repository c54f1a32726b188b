// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/reflections/place/probe_place.h"

#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

namespace hearth::reflections
{

namespace
{

/// Largest coordinate, metres: floats hold a tenth of a millimetre there.
constexpr float kMaxCoordinate = 1e6f;

std::vector<std::string_view> split(std::string_view text, char separator)
{
    std::vector<std::string_view> pieces;
    for (size_t end; (end = text.find(separator)) != std::string_view::npos; text.remove_prefix(end + 1))
        pieces.push_back(text.substr(0, end));
    pieces.push_back(text);
    return pieces;
}

std::optional<float> parseNumber(std::string_view text)
{
    float value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_whole = error == std::errc() && end == text.data() + text.size();
    return is_whole && std::abs(value) <= kMaxCoordinate ? std::optional(value) : std::nullopt;
}

std::optional<Float3> parsePoint(std::string_view text)
{
    const std::vector<std::string_view> words = split(text, ',');
    if (words.size() != 3)
        return {};
    const auto x = parseNumber(words[0]), y = parseNumber(words[1]), z = parseNumber(words[2]);
    return x && y && z ? std::optional(Float3{*x, *y, *z}) : std::nullopt;
}

bool holds(const Box3& box, Float3 p)
{
    return box.min.x < p.x && p.x < box.max.x && box.min.y < p.y && p.y < box.max.y && box.min.z < p.z &&
           p.z < box.max.z;
}

} // namespace

Result<ProbePlace> parseProbePlace(const std::string& text)
{
    const auto wrong = [&](std::string detail) { return Error{Issue::usage, "", text, std::move(detail)}; };
    const std::vector<std::string_view> pieces = split(text, ':');
    const std::optional<Float3> position = parsePoint(pieces[0]);
    if (!position || pieces.size() == 2 || pieces.size() > 4)
        return wrong("the place of a probe is X,Y,Z, or X,Y,Z:MIN:MAX with two corners of its box, each as "
                     "X,Y,Z, or X,Y,Z:MIN:MAX:FADE; in metres, up to a million");
    ProbePlace place{*position, {}, {}};
    if (pieces.size() == 1)
        return place;
    const std::optional<Float3> low = parsePoint(pieces[1]), high = parsePoint(pieces[2]);
    if (!low || !high || !holds({*low, *high}, *position))
        return wrong(
            "the box of a probe is its least and its greatest corner, each as X,Y,Z, and the probe is "
            "inside of it");
    place.box = Box3{*low, *high};
    if (pieces.size() == 4)
    {
        place.fade = parseNumber(pieces[3]);
        if (!place.fade || !(*place.fade > 0))
            return wrong("the distance over which a probe fades is a number above 0");
    }
    return place;
}

} // namespace hearth::reflections
