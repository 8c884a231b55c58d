// The folder of the videos' files, beside the database: clips, clips that are being built,
// and what was uploaded and waits for its job.
//
//   <database>.videos/<id>-<revision>.mrv   a clip, as schema/README.md says
//                     building-<job>        a clip on its way; has no meaning after a crash
//                     input-<number>        what a job was sent; kept until the job has ended
//
// Errors   kIo naming the path, which goes to the log and to nobody else.
// Threads  const-thread-safe; take_input() from any thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "schema/video_store.h"
#include "server/app/file_descriptor.h"

namespace haarmony::server {

class VideoFiles {
  public:
    explicit VideoFiles(const std::string& database_path);

    // Makes the folder where there is none.
    [[nodiscard]] Result<void> prepare() const;

    [[nodiscard]] std::string clip_path(std::int64_t id, std::string_view revision) const;
    [[nodiscard]] std::string building_path(std::int64_t job) const;
    [[nodiscard]] std::string input_path(std::string_view input) const;
    [[nodiscard]] const std::string& folder() const { return folder_; }
    // How much may still be written to the folder's disk.
    [[nodiscard]] Result<std::uint64_t> free_bytes() const;

    // Writes the bytes, flushed to the disk, and tells the name to ask input_path() with.
    // The name is not used again while the file is there.
    [[nodiscard]] Result<std::string> take_input(std::span<const std::byte> bytes);
    // Nothing to remove is no error.
    void remove_input(std::string_view input) const;
    void remove_clip(const schema::Video& video) const;

    // A finished file gets the name of its clip, and the folder is flushed.
    // Requires: the file's content is on the disk.
    [[nodiscard]] Result<void> publish(const std::string& built,
                                       const schema::Video& video) const;

    // Deletes what belongs to nobody: clips without a row, clips that were being built,
    // inputs that no job `wants`. How many.
    [[nodiscard]] Result<std::int64_t> sweep(
        std::span<const schema::Video> videos,
        const std::function<bool(std::string_view input)>& wants) const;

  private:
    [[nodiscard]] Result<void> sync_folder() const;

    std::string folder_;
    std::atomic<std::uint64_t> next_input_{0};
};

// Whether the name is one that take_input() gives: what a row of the database says is not
// taken for a path unseen.
[[nodiscard]] bool is_input_name(std::string_view name);

}  // namespace haarmony::server
