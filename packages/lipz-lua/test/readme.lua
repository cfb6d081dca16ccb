--- Runs the first program of a page, and compares its output with the text below it.

local files = require("test.files")

local bank = "fixtures/banks/v1/drama.lipzbank"

--- Runs a chunk of code with `print` and `io.open` of the test. Returns what it has printed.
local function run(code)
  local printed, usual_print, usual_open = {}, print, io.open
  print = function(...)
    local words = {}
    for index = 1, select("#", ...) do words[index] = tostring((select(index, ...))):gsub("%.0$", "") end
    printed[#printed + 1] = (table.concat(words, " "):gsub(" +$", ""))
  end
  io.open = function(_, mode) return usual_open(files.root .. "/" .. bank, mode) end
  local is_fine, problem = pcall(assert((loadstring or load)(code)))
  print, io.open = usual_print, usual_open
  return is_fine and table.concat(printed, "\n") .. "\n" or problem .. "\n"
end

--- Tests a page. Returns the number of lines of output, and an error message or nil.
return function(path)
  local page = files.read(path)
  local code, expected = page:match("```lua\n(.-)```\n\n```text\n(.-)```")
  return #files.lines(expected), files.difference(path, run(code), expected)
end
