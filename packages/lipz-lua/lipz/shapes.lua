--- The shapes of a model, by their names: which of them take the weights of a rig.

local shape_names = require("lipz.shape_names")

local MOST_LISTED = 5

--- The shapes of a model, with `kind` (nil if none has a known name), `weight_names`, `map` (the index in the list of
-- names for each weight that has a shape), `missing` (the weights without a shape, each with `name` and, if one is
-- similar, `suggestion`), and `report`, a sentence about them (nil if none is missing).
local Shapes = {}
Shapes.__index = Shapes

--- Returns, for each degree of similarity, the index of a name by its form in this degree.
local function forms_of(names)
  local degrees = { {}, {}, {}, {}, {} }
  for index, name in ipairs(names) do
    for degree, form in ipairs((shape_names.forms(name))) do
      if form ~= "" and not degrees[degree][form] then degrees[degree][form] = index end
    end
  end
  return degrees
end

local function index_of(weight, degrees, also)
  local known = { shape_names.letters(weight) }
  for _, name in ipairs(also or {}) do known[#known + 1] = shape_names.letters(name) end
  local _, bare = shape_names.forms(weight)
  known[#known + 1] = bare -- a rig may have a prefix that the model lacks
  for _, by_form in ipairs(degrees) do
    for _, form in ipairs(known) do
      if by_form[form] then return by_form[form] end
    end
  end
  return nil
end

local function map_of(weight_names, degrees, also)
  local map, count = {}, 0
  for _, weight in ipairs(weight_names) do
    map[weight] = index_of(weight, degrees, also[weight])
    if map[weight] then count = count + 1 end
  end
  return map, count
end

local function weight_names_of(kind)
  local list = {}
  for _, name in ipairs(kind.mouth) do list[#list + 1] = name end
  for _, name in ipairs(kind.rest) do list[#list + 1] = name end
  return list
end

--- Returns the kind of which the model has the most shapes of the mouth.
local function recognised(degrees)
  local best, most = nil, 0
  for _, kind in ipairs(shape_names.KINDS) do
    local _, count = map_of(kind.mouth, degrees, kind.also)
    if count > most then best, most = kind, count end
  end
  return best
end

local function also_of(rig_name)
  for _, kind in ipairs(shape_names.KINDS) do
    if kind.kind == rig_name then return kind.also end
  end
  return {}
end

local function listed(words)
  local shown = {}
  for index = 1, math.min(#words, MOST_LISTED) do shown[index] = words[index] end
  if #words > MOST_LISTED then shown[#shown + 1] = ("%d more"):format(#words - MOST_LISTED) end
  return table.concat(shown, ", ")
end

local function missing_of(shapes, others)
  local names = shapes.weight_names
  if not shapes.kind then
    names = {}
    for _, kind in ipairs(shape_names.KINDS) do
      for _, name in ipairs(weight_names_of(kind)) do names[#names + 1] = name end
    end
  end
  local list = {}
  for _, name in ipairs(names) do
    local suggestion = not shapes.map[name] and shape_names.nearest(name, others)
    if not shapes.map[name] and (shapes.kind or suggestion) then
      list[#list + 1] = { name = name, suggestion = suggestion }
    end
  end
  return list
end

local function report_of(shapes, others)
  local words = {}
  for index, found in ipairs(shapes.missing) do
    words[index] = found.suggestion and ("%s (did you mean %s?)"):format(found.name, found.suggestion) or found.name
  end
  if not shapes.kind then
    local hint = #words > 0 and "expected " .. listed(words) or "pass the rig that names them, or rename them"
    return ("none of %d shapes has a known name (%s); %s"):format(#others, listed(others), hint)
  end
  if #words == 0 then return nil end
  return ("%d of %d shapes of %s are missing: %s"):format(#words, #shapes.weight_names, shapes.kind, listed(words))
end

--- Recognises the shapes of a model by a list of their names. With a rig of a bank, finds the shapes for its weights.
function Shapes.new(names, rig)
  local degrees = forms_of(names)
  local kind = not rig and recognised(degrees) or nil
  local shapes = setmetatable({ kind = rig and rig.name or kind and kind.kind, map = {} }, Shapes)
  shapes.weight_names = rig and rig.weight_names or kind and weight_names_of(kind) or {}
  shapes.map = map_of(shapes.weight_names, degrees, rig and also_of(rig.name) or kind and kind.also or {})
  shapes.names, shapes.from, shapes.to = {}, {}, {}
  local is_used, others = {}, {}
  for index, weight in ipairs(shapes.weight_names) do
    local to = shapes.map[weight]
    if to then
      is_used[names[to]] = true
      shapes.from[#shapes.from + 1], shapes.to[#shapes.to + 1] = index, to
      shapes.names[#shapes.names + 1] = names[to]
    end
  end
  for _, name in ipairs(names) do
    if not is_used[name] then others[#others + 1] = name end
  end
  shapes.missing = missing_of(shapes, others)
  shapes.report = report_of(shapes, others)
  return shapes
end

--- Writes each weight to the index of its shape in `influences`.
function Shapes:apply(weights, influences)
  for place, to in ipairs(self.to) do influences[to] = weights[self.from[place]] end
end

--- Calls a function with the name of each shape, its weight, and its index in the list of names.
function Shapes:each(weights, set)
  for place, to in ipairs(self.to) do set(self.names[place], weights[self.from[place]], to) end
end

--- For a model with a shape for each viseme, sets that of one viseme to 1 and all others to 0.
function Shapes:show(viseme, influences)
  for place, to in ipairs(self.to) do
    influences[to] = self.weight_names[self.from[place]] == viseme and 1 or 0
  end
end

return Shapes
