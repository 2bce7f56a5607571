# With MEDIAL_UNITY the sources of a target are compiled some at a time, as one: what they include
# is read, and the templates that they share are compiled, once for all of them. Sources that are
# compiled together lie in one directory, so that only names without linkage of neighbours can clash.

# Compiles `target`'s sources `size` at a time. Call it after all sources are added, in their folder.
function(medial_compile_together target size)
  if(NOT MEDIAL_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  set(folders "")
  foreach(source ${sources})
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME folder)
    if(NOT folder IN_LIST folders)
      list(APPEND folders ${folder})
      set(count_${folder} 0)
    endif()
    math(EXPR group "${count_${folder}} / ${size}")
    math(EXPR count_${folder} "${count_${folder}} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${group})
  endforeach()
endfunction()
