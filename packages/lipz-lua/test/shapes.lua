--- The names that models give to their shapes.

local files = require("test.files")
local lipz = require("lipz")

local OVR = { "sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "I", "O", "U" }
local VROID = files.words("ALL_Angry ALL_Joy ALL_Sorrow ALL_Surprised EYE_Close MTH_A MTH_I MTH_U MTH_E MTH_O")

local function named(names, rename)
  local list = { "Basis" }
  for index, name in ipairs(names) do list[index + 1] = rename(name) end
  return list
end

local function with_sides(name) return (name:gsub("Left$", "_L"):gsub("Right$", "_R")) end

local function with_underscores(name) return (name:gsub("%u", function(c) return "_" .. c:lower() end)) end

local function prefixed(prefix) return function(name) return prefix .. name end end

local function check(is_right, ...) assert(is_right, table.concat({ ... }, " ")) end

--- Tests the names. Returns the number of models.
return function()
  local bank = assert(lipz.open(files.golden("rigs.lipzbank")))
  local arkit = bank:rig("arkit").weight_names
  local models = {
    { "arkit", named(arkit, prefixed("blendShape1.")) },
    { "arkit", named(arkit, with_sides) },
    { "arkit", named(arkit, with_underscores) },
    { "ovr", named(OVR, prefixed("viseme_")) },
    { "ovr", named(OVR, prefixed("Wolf3D_Head.viseme_")) },
    { "vrm", files.words("aa ih ou ee oh happy angry sad relaxed surprised blink") },
    { "vrm", files.words("Neutral A I U E O Blink Joy Angry Sorrow Fun Surprised") },
    { "vrm", named(VROID, prefixed("Face.M_F00_000_00_Fcl_")) },
    { "mmd", files.words("真面目 困る にこり 怒り まばたき 笑い あ い う え お ん") },
    { "live2d", files.words("PARAM_MOUTH_FORM PARAM_MOUTH_OPEN_Y PARAM_EYE_L_OPEN PARAM_EYE_R_OPEN") },
    { "blair", files.words("rest Mouth_A Mouth_E Mouth_F Mouth_L Mouth_M Mouth_O Mouth_S Mouth_U Mouth_W") },
    { "toonboom", files.words("A B C D E F G X") },
  }
  for _, model in ipairs(models) do
    local shapes = lipz.shapes(model[2])
    check(shapes.kind == model[1] and not shapes.report, model[1], tostring(shapes.kind), shapes.report or "")
  end
  for _, kind in ipairs({ "arkit", "ovr", "vrm", "mmd", "live2d" }) do
    local own = bank:rig(kind)
    local found = lipz.shapes(own.weight_names)
    check(table.concat(found.weight_names, " ") == table.concat(own.weight_names, " "), kind)
  end
  local report = lipz.shapes({ "jawOpen", "mouthFunel", "mouthPuckerr", "smile" }).report
  check(report == "34 of 35 shapes of arkit are missing: mouthClose, mouthFunnel (did you mean mouthFunel?), "
    .. "mouthPucker (did you mean mouthPuckerr?), mouthRollLower, mouthRollUpper, 29 more", report)
  local facefx = lipz.shapes({ "head|Open", "head|w", "head|sh_ch", "wide" }, bank:rig("facefx"))
  check(facefx.map.open == 1 and facefx.map.W == 2 and facefx.map.ShCh == 3 and facefx.map.wide == 4, "facefx")
  local influences = { 9, 9, 9, 9, 9, 9, 9, 9, 9, 9 }
  lipz.shapes(models[11][2]):show("L", influences)
  check(table.concat(influences, "") == "0000100000", table.concat(influences, ""))
  return #models
end
