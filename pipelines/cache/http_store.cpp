// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/http_store.h"

namespace hearth::cache
{

namespace
{

// The longest entries are the lists of files that an import found: 16 times some hundred bytes for each of
// its files.
constexpr uint64_t kMaxEntry_bytes = 64 << 20;

bool isFound(const HttpRequest& request)
{
    return request.status == kHttpOk;
}

/// True if the server does not have the file (404 Not Found, 410 Gone).
bool isMissing(const HttpRequest& request)
{
    return request.status == 404 || request.status == 410;
}

bool isStored(const HttpRequest& request)
{
    return request.status >= 200 && request.status < 300;
}

} // namespace

std::string withoutCredentials(const std::string& url)
{
    const size_t host = url.find("//") + 2;
    const size_t at = url.substr(0, url.find('/', host)).rfind('@');
    return at == std::string::npos ? url : url.substr(0, host) + url.substr(at + 1);
}

HttpStore::HttpStore(std::string url, bool writable, const StallLimits& limits)
    : url_(std::move(url)), name_(withoutCredentials(url_)), writable_(writable), limits_(limits)
{
}

HttpStore::~HttpStore() = default;

Status HttpStore::run(std::span<HttpRequest> requests)
{
    if (!client_)
    {
        HEARTH_ASSIGN_OR_RETURN(client_, HttpClient::open(name_, limits_));
    }
    return client_->run(requests);
}

Error HttpStore::statusError(const HttpRequest& request, const std::string& consequence) const
{
    return {Issue::cache_failed, name_, request.url.substr(url_.size()),
            "the server answers with status " + std::to_string(request.status) + ": " + consequence};
}

Status HttpStore::entries(std::span<EntryRequest> wanted)
{
    std::vector<HttpRequest> requests;
    std::vector<EntryRequest*> asked;
    for (EntryRequest& entry : wanted)
        if (!entry.text)
        {
            requests.push_back(
                {HttpRequest::Kind::get_text, url_ + "/ac/" + entry.key, "", "", kMaxEntry_bytes});
            asked.push_back(&entry);
        }
    if (requests.empty())
        return success();
    Status status = run(requests);
    for (size_t i = 0; i < requests.size(); ++i)
        if (isFound(requests[i]))
            asked[i]->text = std::move(requests[i].text);
        else if (status.ok() && !isMissing(requests[i]))
            status = statusError(requests[i], "it is not asked again");
    return status;
}

Status HttpStore::fetch(std::span<ContentRequest> wanted)
{
    std::vector<HttpRequest> requests;
    std::vector<ContentRequest*> asked;
    for (ContentRequest& content : wanted)
        if (!content.is_found)
        {
            requests.push_back({HttpRequest::Kind::get_file, url_ + "/cas/" + content.hash, "", content.path,
                                content.bytes});
            asked.push_back(&content);
        }
    if (requests.empty())
        return success();
    Status status = run(requests);
    for (size_t i = 0; i < requests.size(); ++i)
    {
        asked[i]->is_found = isFound(requests[i]);
        if (status.ok() && !isFound(requests[i]) && !isMissing(requests[i]))
            status = statusError(requests[i], "it is not asked again");
    }
    return status;
}

Status HttpStore::put(HttpRequest request)
{
    HEARTH_TRY(run({&request, 1}));
    if (isStored(request))
        return success();
    writable_ = false;
    return statusError(request, "nothing more is put there");
}

Status HttpStore::putEntry(const std::string& key, const std::string& text)
{
    return put({HttpRequest::Kind::put_text, url_ + "/ac/" + key, text, ""});
}

Status HttpStore::put(const std::string& hash, const std::string& path, FileAccess)
{
    return put({HttpRequest::Kind::put_file, url_ + "/cas/" + hash, "", path});
}

} // namespace hearth::cache
