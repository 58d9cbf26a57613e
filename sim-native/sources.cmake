# Sources of the native library and of natator-sim, relative to this directory.
set(NATATOR_SCENE_SOURCES
    src/gait/activation.cpp
    src/gait/actuate.cpp
    src/gait/check_gait.cpp
    src/io/strict_json.cpp
    src/model/body.cpp
    src/model/fluid_block.cpp
    src/model/model_builder.cpp
    src/model/muscles.cpp
    src/scene/creature_reader.cpp
    src/scene/data_files.cpp
    src/scene/field.cpp
    src/scene/fluid_reader.cpp
    src/scene/load_scene.cpp
    src/scene/scene_reader.cpp
    src/scene/solver_reader.cpp)

set(NATATOR_CLI_SOURCES)
