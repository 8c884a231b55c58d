#include "ingest/prune.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <vector>

#include "ingest/batch.h"
#include "ingest/file_descriptor.h"
#include "ingest/file_uri.h"

namespace haarmony::ingest {
namespace {

bool is_gone(const std::string& path) {
    const FileDescriptor file = open_path(path, O_PATH);
    struct stat status {};
    if (!file.valid() || ::fstat(file.get(), &status) != 0) {
        return errno == ENOENT || errno == ENOTDIR;
    }
    return !S_ISREG(status.st_mode);
}

}  // namespace

Pruned prune_below(Catalogue& catalogue,
                   const std::string& root,
                   const std::function<bool()>& keep_going) {
    std::vector<ImageId> gone;
    const std::string prefix = root == "/" ? file_uri(root) : file_uri(root) + '/';
    Pruned pruned;
    pruned.outcome = catalogue.for_each_file(
        prefix, [&](const schema::KnownFile& known, const std::string& uri) {
            if (!keep_going()) return;
            const Result<std::string> path = path_from_file_uri(uri);
            if (path && is_gone(*path)) gone.push_back(known.id);
        });
    for (std::size_t start = 0; start < gone.size() && pruned.outcome && keep_going();) {
        const std::size_t end = std::min(gone.size(), start + kBatchRows);
        pruned.outcome = catalogue.transaction([&]() -> Result<void> {
            for (std::size_t i = start; i < end; ++i) {
                Result<void> purged = catalogue.purge(gone[i]);
                // Another process was faster.
                if (!purged && purged.error().code != ErrorCode::kNotFound) return purged;
            }
            return {};
        });
        if (pruned.outcome) pruned.rows += static_cast<std::int64_t>(end - start);
        start = end;
    }
    return pruned;
}

}  // namespace haarmony::ingest
