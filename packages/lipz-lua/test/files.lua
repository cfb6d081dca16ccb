--- The files of the tests. `lipz_test_root` is the path of the repository, by default for a run in
-- `packages/lipz-lua`.

local files = { root = rawget(_G, "lipz_test_root") or "../.." }

--- Returns the bytes of a file of the repository.
function files.read(path)
  local handle = assert(io.open(files.root .. "/" .. path, "rb"))
  local bytes = handle:read("*a")
  handle:close()
  return bytes
end

function files.golden(name) return files.read("fixtures/banks/v1/" .. name) end

--- Returns the lines of a text.
function files.lines(text)
  local list = {}
  for line in text:gmatch("([^\n]*)\n") do list[#list + 1] = line end
  return list
end

function files.words(line)
  local list = {}
  for word in line:gmatch("%S+") do list[#list + 1] = word end
  return list
end

--- Compares two texts line by line. Returns an error message with the first different line, or nil.
function files.difference(name, found, expected)
  local a, b = files.lines(found), files.lines(expected)
  for index = 1, math.max(#a, #b) do
    if a[index] ~= b[index] then
      return ("%s:%d\n  expected: %s\n  found:    %s"):format(name, index, tostring(b[index]), tostring(a[index]))
    end
  end
  return nil
end

return files
