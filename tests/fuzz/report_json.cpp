// What a report's page shows, as it is read back for its charts and its scene. What has another form than ours is told
// by exceptions of the JSON library, which the commands tell in their words.

#include <nlohmann/json.hpp>

#include "fuzz/try_bytes.hpp"
#include "plan/model.hpp"
#include "report/page_charts.hpp"
#include "scene/checked_json.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_json.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

template <class Action>
void read_or_refuse(Action action) {
  try {
    action();
  } catch (const InputError&) {
  } catch (const Json::exception&) {
  }
}

}  // namespace

void try_bytes(const std::string& bytes) {
  read_or_refuse([&] {
    const Json data = parse_json<Json>(bytes);
    for (const char* name : {"outflow", "precision", "fit", "front", "ranking"})
      read_or_refuse([&] { page_chart(data, name); });
    prepare(scene_from_json(data.at("scene").dump()));
  });
}

}  // namespace vibrosow
