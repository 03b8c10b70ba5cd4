# The templates of machine programs (data/templates) as text inside the program, so that their names are known wherever
# it is installed: a list of {"name", R"(text)"} for runs/programs/shipped_templates.cpp.
file(GLOB dwell_templates CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/data/templates/*.toml)
set(dwell_template_list "")
foreach(template IN LISTS dwell_templates)
  get_filename_component(name ${template} NAME_WE)
  string(REPLACE _ - name ${name})
  file(READ ${template} text)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${template})
  string(APPEND dwell_template_list "{\"${name}\", R\"template(${text})template\"},\n")
endforeach()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/include/dwell_shipped_templates.inc CONTENT "@dwell_template_list@" @ONLY)
