// Jobs as the REST interface shows them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "schema/job_store.h"
#include "server/app/job_runner.h"

namespace haarmony::server {

// `rate` and `eta_s` are null where they are not known.
[[nodiscard]] nlohmann::json job_json(const schema::Job& job, const JobRunner& runner);

// "/jobs/12".
[[nodiscard]] std::string job_address(std::int64_t id);

}  // namespace haarmony::server
