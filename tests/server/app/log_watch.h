// The lines of the log that hold a text, from when a test begins to look.
#pragma once

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace haarmony::server {

class LogWatch {
  public:
    explicit LogWatch(std::string text) : text_(std::move(text)) { hub()->add(this); }
    ~LogWatch() { hub()->remove(this); }
    LogWatch(const LogWatch&) = delete;
    LogWatch& operator=(const LogWatch&) = delete;

    [[nodiscard]] std::vector<std::string> lines() const {
        return hub()->lines_of(*this);
    }

  private:
    class Hub final : public spdlog::sinks::base_sink<std::mutex> {
      public:
        void add(LogWatch* watch) {
            const std::lock_guard lock(mutex_);
            watches_.insert(watch);
        }
        void remove(LogWatch* watch) {
            const std::lock_guard lock(mutex_);
            watches_.erase(watch);
        }
        std::vector<std::string> lines_of(const LogWatch& watch) {
            const std::lock_guard lock(mutex_);
            return watch.lines_;
        }

      protected:
        void sink_it_(const spdlog::details::log_msg& message) override {
            const std::string line(message.payload.data(), message.payload.size());
            for (LogWatch* watch : watches_)
                if (line.find(watch->text_) != std::string::npos)
                    watch->lines_.push_back(line);
        }
        void flush_() override {}

      private:
        std::set<LogWatch*> watches_;
    };

    // Added before main(): no thread logs yet.
    static const std::shared_ptr<Hub>& hub() {
        static const std::shared_ptr<Hub> only = [] {
            auto made = std::make_shared<Hub>();
            spdlog::default_logger()->sinks().push_back(made);
            return made;
        }();
        return only;
    }
    inline static const bool is_added = hub() != nullptr;

    const std::string text_;
    std::vector<std::string> lines_;
};

}  // namespace haarmony::server
