// Parses JSON into events (SAX style), for callers that store the document in a form of their own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hearth
{

/// Receiver of the events of a JSON text, in the order of the text. Each function returns whether to
/// continue. Strings may be moved from.
class JsonEvents
{
public:
    virtual bool null() = 0;
    virtual bool boolean(bool value) = 0;
    virtual bool integer(int64_t value) = 0; ///< negative integer
    virtual bool unsignedInteger(uint64_t value) = 0;
    virtual bool number(double value) = 0; ///< any other number, also an integer that does not fit 64 bits
    virtual bool string(std::string& text) = 0;
    virtual bool beginArray() = 0;
    virtual bool endArray() = 0;
    virtual bool beginObject() = 0;
    virtual bool key(std::string& text) = 0; ///< its value follows
    virtual bool endObject() = 0;

protected:
    ~JsonEvents() = default;
};

/// Parse `text` strictly and send its events to `events` (RFC 8259, in UTF-8; a number too large for a double
/// is an error).
/// returns  the number of bytes read before the error; nullopt if the text is valid, or `events` stopped the
///          parser
std::optional<size_t> parseJson(std::string_view text, JsonEvents& events);

} // namespace hearth
