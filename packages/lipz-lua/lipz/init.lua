--- Reads lipz dialogue banks: visemes, subtitles, events and weights of faces at a time.
--
--     local lipz = require("lipz") -- in Defold: require("lipz.init")
--     local bank = assert(lipz.open(bytes))

local Bank = require("lipz.bank")
local Shapes = require("lipz.shapes")
require("lipz.cursor")
require("lipz.rig")
require("lipz.babble")
require("lipz.voice")
require("lipz.checksum")

local lipz = {}

--- Opens a bank from its bytes, a string. Returns the bank, or nil, a message, and a table with `kind`, `status` and
-- `offset_bytes`.
lipz.open = Bank.open

--- Recognises the shapes of a model by a list of their names. With a rig of a bank, finds the shapes for its weights.
lipz.shapes = Shapes.new

return lipz
