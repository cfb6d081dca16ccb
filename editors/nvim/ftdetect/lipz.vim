" Files that end in .lipz are Lipz files.
autocmd BufNewFile,BufRead *.lipz setfiletype lipz
