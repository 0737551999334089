// The loads of obstacles, from what contacts record in a step to the sums of a run. Contacts are on many threads and
// ranks; the sums are exact until they are rounded, so that they have the same bits for any number of both.
#pragma once

#include "engine/state/simulation.h"
#include "engine/stepping/step_cache.h"

namespace engine {

/// Records loads of contacts, and passes them on when it is destroyed. Inline, because most particles have none.
class LoadRecorder {
 public:
    explicit LoadRecorder(Simulation& simulation)
        : shared_(simulation.cache->loads), isRecording_(!simulation.setup.obstacles.areRecorded.empty()) {}
    LoadRecorder(const LoadRecorder&) = delete;
    LoadRecorder& operator=(const LoadRecorder&) = delete;
    ~LoadRecorder() {
        if (!loads_.empty()) shared_.add(loads_);
    }

    /// The list in which contacts are recorded; null where the loads of no obstacle are.
    ContactLoads* list() { return isRecording_ ? &loads_ : nullptr; }
    /// Forgets what was recorded.
    void clear() { loads_.clear(); }

 private:
    SharedLoads& shared_;
    bool isRecording_;
    ContactLoads loads_;
};

/// Adds what was recorded since the last call to the loads of the present step, and its work to that of all steps.
void addUpLoads(Simulation& simulation);

/// Adds the loads of a step that was accepted to those of the run.
void acceptLoads(Simulation& simulation);

}  // namespace engine
