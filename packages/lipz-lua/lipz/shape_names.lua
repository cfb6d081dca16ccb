--- The names that models give to their shapes: morph targets, blend shapes, parameters. Each kind has the name of the
-- bank's rig whose weights its shapes take, or of a viseme type.

local shape_names = {}

local function both_sides(list, ...)
  for _, name in ipairs({ ... }) do
    list[#list + 1] = name .. "Left"
    list[#list + 1] = name .. "Right"
  end
  return list
end

local function words(text)
  local list = {}
  for word in text:gmatch("%S+") do list[#list + 1] = word end
  return list
end

local ARKIT_MOUTH = both_sides(
  words("jawOpen mouthClose mouthFunnel mouthPucker mouthRollLower mouthRollUpper mouthShrugLower"),
  "mouthPress", "mouthStretch", "mouthSmile", "mouthFrown", "mouthUpperUp", "mouthLowerDown")
local ARKIT_REST = both_sides({ "tongueOut" }, "cheekSquint", "noseSneer", "browDown")
ARKIT_REST[#ARKIT_REST + 1] = "browInnerUp"
both_sides(ARKIT_REST, "browOuterUp", "eyeWide", "eyeSquint", "eyeBlink")

--- The kinds, the first of which counts if a model has the shapes of several. `mouth` lists the weights of the mouth,
-- by which a kind is recognised, and `rest` all others. `also` has further names of a weight.
shape_names.KINDS = {
  { kind = "arkit", mouth = ARKIT_MOUTH, rest = ARKIT_REST, also = {} },
  {
    kind = "ovr", mouth = words("sil PP FF TH DD kk CH SS nn RR aa E ih oh ou"), rest = {},
    also = { ih = { "I" }, oh = { "O" }, ou = { "U" } },
  },
  {
    kind = "vrm", mouth = words("aa ih ou ee oh"), rest = words("happy angry sad surprised blink"),
    also = {
      aa = { "A" }, ih = { "I" }, ou = { "U" }, ee = { "E" }, oh = { "O" },
      happy = { "Fcl_ALL_Joy", "Joy" }, angry = { "Fcl_ALL_Angry" }, sad = { "Fcl_ALL_Sorrow", "Sorrow" },
      surprised = { "Fcl_ALL_Surprised" }, blink = { "Fcl_EYE_Close" },
    },
  },
  { kind = "mmd", mouth = words("あ い う え お ん"), rest = words("まばたき にこり 怒り 困る"), also = {} },
  {
    kind = "live2d", mouth = words("ParamMouthOpenY ParamMouthForm"), rest = words("ParamEyeLOpen ParamEyeROpen"),
    also = {},
  },
  { kind = "blair", mouth = words("A E F L M O S U W"), rest = { "-" }, also = { ["-"] = { "rest" } } },
  { kind = "toonboom", mouth = words("A B C D E F G"), rest = { "-" }, also = { ["-"] = { "rest", "X" } } },
  { kind = "rms", mouth = words("0 1 2 3 4 5 6 7 8 9"), rest = { "-" }, also = { ["-"] = { "rest" } } },
}

--- The kinds of a shape before its name: `viseme_aa`, `v_aa`, `Fcl_MTH_A`, `Mouth_A`.
local PREFIXES = words("arkit fcl_mth lipsync mouth mth phoneme v viseme")

--- Returns the letters and digits of a name in lower case, which alone are compared.
local function letters(name)
  if name == "-" then return name end -- the code of rest
  return (name:gsub("[^%w\128-\255]", ""):lower())
end
shape_names.letters = letters

--- Removes the names of meshes and deformers before that of a shape: `blendShape1.jawOpen`, `M_F00_000_00_Fcl_MTH_A`.
local function without_path(name)
  local first = 1
  for at = 1, #name - 1 do
    if name:sub(at, at):find("[.:|/]") then first = at + 1 end
  end
  for at = first, #name do
    if name:sub(at, at + 3) == "Fcl_" then first = at end
  end
  return name:sub(first)
end

local function without_prefix(name)
  local lower = name:lower()
  for _, prefix in ipairs(PREFIXES) do
    if lower:sub(1, #prefix) == prefix and lower:sub(#prefix + 1, #prefix + 1):find("[_ %-]") then
      return name:sub(#prefix + 2)
    end
  end
  return name
end

--- Writes out the side at the end of a name: `mouthSmile_L`, `eyeBlink.R`, `jawL`.
local function with_side(name)
  local before, side = name:match("^(.*)[_. %-]([lrLR])$")
  if not side then before, side = name:match("^(.*%l)([LR])$") end
  if not side then return name end
  return before .. (side:lower() == "l" and "Left" or "Right")
end

--- Returns the forms in which a name is compared, in the order of their similarity to it, and the bare form.
function shape_names.forms(name)
  local plain, sided = without_path(name), without_path(with_side(name))
  local bare = letters(without_prefix(plain))
  return { letters(name), letters(plain), bare, letters(sided), letters(without_prefix(sided)) }, bare
end

--- Returns the number of letters that are missing, wrong, extra or swapped with the next.
local function distance(a, b)
  local before, last = nil, {}
  for index = 0, #b do last[index] = index end
  for i = 1, #a do
    local row = { [0] = i }
    for j = 1, #b do
      row[j] = math.min(last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i] == b[j] and 0 or 1))
      if i > 1 and j > 1 and a[i] == b[j - 1] and a[i - 1] == b[j] then row[j] = math.min(row[j], before[j - 2] + 1) end
    end
    before, last = last, row
  end
  return last[#b]
end

local function characters(text)
  local list = {}
  for character in text:gmatch("[^\128-\191][\128-\191]*") do list[#list + 1] = character end
  return list
end

--- Returns the name from a list that is nearest to a known name; nil if more than a third of the letters differ.
function shape_names.nearest(known, names)
  local wanted = characters(letters(known))
  local best, least = nil, math.floor(#wanted / 3) + 1
  for _, name in ipairs(names) do
    local found = distance(characters(letters(name)), wanted)
    if found < least then best, least = name, found end
  end
  return best
end

return shape_names
