// SPDX-License-Identifier: BSD-3-Clause
#include "session/stamp_order.h"

#include "mivo/core/error.h"

namespace mivo {

void refuseEqualStamps(std::size_t count, double stamp) {
  throw Error("all " + std::to_string(count) + " stamps are " + std::to_string(stamp) +
              ": without times nothing can be tracked");
}

std::string describe(const StampOrder& order, const std::string& items) {
  if (order.was_sorted && order.doubled == 0) return {};
  const std::string doubled = std::to_string(order.doubled);
  if (order.was_sorted) {
    return doubled + " of the " + items + " left out: others have the same stamps";
  }
  return "the " + items + " were not in the order of their stamps and are sorted" +
         (order.doubled == 0 ? ""
                             : "; " + doubled + " of them left out: others have the same stamps");
}

}  // namespace mivo
