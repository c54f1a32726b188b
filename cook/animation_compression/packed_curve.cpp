// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_compression/packed_curve.h"

#include "cook/animation_bounds/quaternion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace hearth::animation_compression
{

using namespace formats;

namespace
{

/// Three components of a key that are stored.
struct StoredComponents
{
    uint32_t largest = 0;
    std::array<double, 3> values{};
};

StoredComponents storedComponents(AnimationPath path, const KeyValue& value)
{
    if (path != AnimationPath::rotation)
        return {0, {value[0], value[1], value[2]}};
    StoredComponents numbers;
    for (uint32_t i = 1; i < 4; ++i)
        if (std::abs(value[i]) > std::abs(value[numbers.largest]))
            numbers.largest = i;
    const double sign = value[numbers.largest] < 0 ? -1 : 1;
    for (uint32_t i = 0; i < 3; ++i)
        numbers.values[i] = sign * value[i < numbers.largest ? i : i + 1];
    return numbers;
}

struct QuantisedCurve
{
    PackedCurve packed;           ///< with all keys
    std::vector<KeyValue> values; ///< decoded values
};

/// Quantise all keys, with `bits` bits for the component with the largest range. Nothing if a code needs too
/// many bits.
std::optional<QuantisedCurve> quantise(const Curve& curve, std::span<const StoredComponents> numbers,
                                       uint32_t bits)
{
    std::array<double, 3> low, high;
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (const StoredComponents& key : numbers)
        for (size_t i = 0; i < 3; ++i)
        {
            low[i] = std::min(low[i], key.values[i]);
            high[i] = std::max(high[i], key.values[i]);
        }
    const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    QuantisedCurve result;
    result.packed.step = static_cast<float>(extent / (std::exp2(bits) - 1));
    for (size_t i = 0; i < 3; ++i)
        result.packed.base[i] = static_cast<float>(low[i]);
    const double step = double{result.packed.step};
    for (size_t k = 0; k < numbers.size(); ++k)
    {
        PackedCurve::Key key{k, numbers[k].largest, {}};
        std::array<double, 3> read{};
        for (size_t i = 0; i < 3; ++i)
        {
            const double base = double{result.packed.base[i]};
            const double code = step > 0 ? std::round((numbers[k].values[i] - base) / step) : 0.0;
            if (!(code < std::exp2(kMaxKeyFieldBits)))
                return std::nullopt;
            key.codes[i] = static_cast<uint32_t>(std::max(code, 0.0));
            read[i] = base + step * key.codes[i];
            result.packed.bits[i] =
                std::max(result.packed.bits[i], static_cast<uint8_t>(std::bit_width(key.codes[i])));
        }
        result.packed.keys.push_back(key);
        result.values.push_back(curve.path == AnimationPath::rotation
                                    ? animation_bounds::normalizedOrNone(restoreRotation(key.largest, read))
                                    : KeyValue{read[0], read[1], read[2], 0});
    }
    return result;
}

/// Removes keys: from each kept key, the next one is as far away as a linear piece stays within the
/// tolerance. Searches by doubling and bisection.
class KeyReduction
{
public:
    KeyReduction(const Curve& curve, std::span<const KeyValue> values, double tolerance)
        : curve_(curve), values_(values), tolerance_(tolerance)
    {
    }

    /// Return the indices of the kept keys; empty if adjacent keys already exceed the tolerance.
    std::vector<size_t> keys()
    {
        // steps hold until the end; linear pieces need their last key
        const size_t end = curve_.steps ? values_.size() : values_.size() - 1;
        std::vector<size_t> kept;
        size_t at = 0;
        for (; at < end; at = next(at, end))
        {
            if (!keep(at) || deviation(at, at + 1) > tolerance_)
                return {};
            kept.push_back(at);
        }
        if (!curve_.steps)
        {
            if (!keep(at))
                return {};
            kept.push_back(at);
        }
        return kept;
    }

    double worst() const { return worst_; }

private:
    /// Measure a key whose value holds by itself: before the first key, and behind the last one. True if it
    /// is within tolerance.
    bool keep(size_t key)
    {
        const double off = distance(curve_.path, curve_.values[key], values_[key]);
        worst_ = std::max(worst_, off);
        return off <= tolerance_;
    }

    double deviation(size_t first, size_t last) const
    {
        const KeyValue& end = values_[std::min(last, values_.size() - 1)];
        return pieceDeviation(curve_, first, last, values_[first], end, tolerance_);
    }

    size_t next(size_t first, size_t end)
    {
        size_t good = first + 1, bad = end + 1;
        for (size_t stride = 2; first + stride < bad; stride *= 2)
            (deviation(first, first + stride) <= tolerance_ ? good : bad) = first + stride;
        while (bad - good > 1)
        {
            const size_t middle = good + (bad - good) / 2;
            (deviation(first, middle) <= tolerance_ ? good : bad) = middle;
        }
        worst_ = std::max(worst_, deviation(first, good));
        return good;
    }

    const Curve& curve_;
    std::span<const KeyValue> values_;
    double tolerance_;
    double worst_ = 0;
};

size_t sizeBits(const PackedCurve& packed, AnimationPath path)
{
    return packed.keys.size() * packed.keyBits(path);
}

} // namespace

std::optional<PackedCurve> packCurve(const Curve& curve, double tolerance)
{
    std::vector<StoredComponents> numbers;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const KeyValue& value : curve.values)
    {
        numbers.push_back(storedComponents(curve.path, value));
        for (const double number : numbers.back().values)
        {
            low = std::min(low, number);
            high = std::max(high, number);
        }
    }
    // try six widths of codes around steps as wide as the tolerance: finer codes leave more tolerance for
    // removing keys
    const double widest = std::log2((high - low) / tolerance + 1);
    const auto min_bits = static_cast<uint32_t>(std::clamp(std::ceil(widest) - 2, 1.0, 24.0));
    std::optional<PackedCurve> best;
    for (uint32_t bits = min_bits; bits <= std::min(min_bits + 5, kMaxKeyFieldBits); ++bits)
    {
        std::optional<QuantisedCurve> candidate = quantise(curve, numbers, bits);
        if (!candidate)
            continue;
        KeyReduction reduction(curve, candidate->values, tolerance - curve.remainder);
        const std::vector<size_t> kept = reduction.keys();
        if (kept.empty())
            continue;
        PackedCurve packed = std::move(candidate->packed);
        for (size_t i = 0; i < kept.size(); ++i)
            packed.keys[i] = packed.keys[kept[i]];
        packed.keys.resize(kept.size());
        packed.deviation = reduction.worst() + curve.remainder;
        if (!best || sizeBits(packed, curve.path) < sizeBits(*best, curve.path))
            best = std::move(packed);
    }
    return best;
}

} // namespace hearth::animation_compression
