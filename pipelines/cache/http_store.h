// Cache on an HTTP server: ac/KEY and cas/SHA256 by GET and PUT, as bazel-remote has them, or nginx over a
// directory.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/cache_level.h"
#include "pipelines/cache/http_client.h"

#include <memory>
#include <vector>

namespace hearth::cache
{

/// Return the URL without user and password, for messages.
std::string withoutCredentials(const std::string& url);

/// Cache on an HTTP server. libcurl is loaded, and the server contacted, at the first request. After a
/// refused PUT (read only, full, too large) nothing more is written to the server. A server that cannot be
/// reached, breaks off or is too slow is an error.
class HttpStore : public CacheLevel
{
public:
    /// url  http(s)://[user:password@]host[:port]/path, without a '/' at its end; messages omit user and
    ///      password
    HttpStore(std::string url, bool writable, const StallLimits& limits = {});
    ~HttpStore() override;

    const std::string& name() const override { return name_; }
    bool isWritable() const override { return writable_; }
    bool isRemote() const override { return true; }
    Status entries(std::span<EntryRequest> wanted) override;
    Status putEntry(const std::string& key, const std::string& text) override;
    Status fetch(std::span<ContentRequest> wanted) override;
    Status put(const std::string& hash, const std::string& path, FileAccess use) override;
    /// Do nothing: damaged data is overwritten by the next PUT. Few servers allow DELETE.
    void removeEntry(const std::string&) override {}
    void removeContent(const std::string&) override {}

private:
    Status run(std::span<HttpRequest> requests);
    Status put(HttpRequest request);
    Error statusError(const HttpRequest& request, const std::string& consequence) const;

    std::string url_;
    std::string name_;
    bool writable_;
    StallLimits limits_;
    std::unique_ptr<HttpClient> client_; ///< null before the first request
};

} // namespace hearth::cache
