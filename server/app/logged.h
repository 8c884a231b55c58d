// Answers on their way to a client, who sees of a failed database only that the server could
// not answer: the log says why.
#pragma once

#include <spdlog/spdlog.h>

#include "engine/core/result.h"
#include "server/app/log_value.h"

namespace haarmony::server {

// Requires: Answer is a Result.
template <typename Answer>
Answer logged(Answer answer) {
    if (!answer && answer.error().code == ErrorCode::kIo)
        spdlog::error("event=database_failed reason={}",
                      log_value(answer.error().message));
    return answer;
}

}  // namespace haarmony::server
