#pragma once

#include <geometry_msgs/PointStamped.h>

#include "cloth_sim/Pin.h"
#include "cloth_sim/simulation/simulation.h"

#include "frames.h"
#include "pin_attachments.h"

namespace cloth
{

/// Carries out a message of ~pin; `duration` (s of simulated time) is what a MOVE may take. A pin that is moved, or
/// made anew, leaves the frame that carried it. Throws RefusedRequest where the message makes no sense for this cloth;
/// the cloth is then as it was.
void apply_pin(const cloth_sim::Pin& request, const Frames& frames, double duration, Simulation& simulation,
               PinAttachments& attachments);

/// The message that pins the node nearest to `point`, called by its row and column.
cloth_sim::Pin pin_nearest_to(const geometry_msgs::PointStamped& point);

}  // namespace cloth
