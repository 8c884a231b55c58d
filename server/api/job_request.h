// What a job is asked to do, checked before it is queued, so that what can never succeed is
// refused at once.
//
// Errors  left in the inputs: 400 naming the parameter, 403 for a path that is not below a
//         media root.
#pragma once

#include <string>

#include "server/api/context.h"
#include "server/api/inputs.h"

namespace haarmony::server {

struct JobRequest {
    std::string type;
    std::string request;  // the JSON object that the job's type reads
};

[[nodiscard]] JobRequest read_job_request(const Context& context, Inputs& inputs);

}  // namespace haarmony::server
